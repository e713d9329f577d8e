#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "hil/bus/candump/recording.hpp"
#include "hil/bus/decode/decoder.hpp"
#include "hil/bus/decode/printer.hpp"

namespace earshot::hil {

/// What of a bus is shown.
struct Shown {
  std::set<std::uint32_t> pgns;         ///< empty: all
  std::optional<std::uint32_t> source;  ///< none: all
};

/// From entries to what is printed and recorded.
class Dump {
 public:
  /// All live as long as the dump.
  Dump(Shown shown, Printer& printer, std::ostream& out, Recording* recording)
      : shown_(std::move(shown)), printer_(printer), out_(out), recording_(recording) {}

  /// @return false: the entry names one interface too many
  [[nodiscard]] bool take(const LogEntry& entry);

  [[nodiscard]] DecoderCounters counters() const { return decoder_.counters(); }
  /// Messages that were printed.
  [[nodiscard]] std::uint64_t printed() const { return printed_; }
  /// Messages that a recorder put together and that are too long for frames that could be recorded.
  [[nodiscard]] std::uint64_t unrecorded() const { return unrecorded_; }

 private:
  void record(const LogEntry& entry);
  /// As the frames that it came of.
  void record_message(const LogEntry& entry);

  Shown shown_;
  Printer& printer_;
  std::ostream& out_;
  Recording* recording_;
  Decoder decoder_;
  std::map<std::pair<std::uint32_t, std::uint8_t>, std::uint8_t> sequences_;  ///< of the next fast packet, by group and source
  std::uint64_t printed_ = 0;
  std::uint64_t unrecorded_ = 0;
};

}  // namespace earshot::hil
