#pragma once

#include <cstdint>
#include <iosfwd>
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

 private:
  Shown shown_;
  Printer& printer_;
  std::ostream& out_;
  Recording* recording_;
  Decoder decoder_;
};

}  // namespace earshot::hil
