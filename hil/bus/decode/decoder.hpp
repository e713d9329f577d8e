#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/sensors/directory.hpp"
#include "firmware/wire/n2k/signals.hpp"
#include "hil/bus/candump/log_line.hpp"
#include "hil/bus/decode/fast_packets.hpp"
#include "hil/bus/decode/value.hpp"

namespace earshot::hil {

/// A message as it was heard.
struct Heard {
  std::optional<Time> time;  ///< of its first frame
  std::string interface;
  n2k::Identifier identifier;
  std::string source_name{};              ///< the device's model, or its NAME; empty: neither was heard. Any bytes
  const n2k::Message* message = nullptr;  ///< null: not in the table, or another maker's
  std::vector<std::uint8_t> bytes{};
  std::vector<Value> values{};  ///< of a message in the table
};

struct DecoderCounters {
  std::uint64_t frames = 0;
  std::uint64_t other_frames = 0;  ///< not of NMEA 2000
  std::uint64_t messages = 0;
  std::uint64_t unknown = 0;     ///< of them, not in the table
  std::uint64_t incomplete = 0;  ///< fast packets that are not whole, and frames that belong to none
};

/// Whether messages of a group in the table go as fast packets, however short they are.
[[nodiscard]] bool is_fast(std::uint32_t pgn);

/// Turns frames into messages: puts fast packets together, however many devices send at once, and remembers who has which address.
class Decoder {
 public:
  /// Of one candump, as many as it takes itself; a log that names more is none.
  static constexpr std::size_t kMostInterfaces = 16;

  enum class Taken : std::uint8_t { kMessage, kNothingYet, kTooManyInterfaces };
  /// @param heard  is set with kMessage
  [[nodiscard]] Taken accept(const LogEntry& entry, Heard& heard);

  [[nodiscard]] DecoderCounters counters() const;

 private:
  struct Bus {
    n2k::Directory devices;
    std::array<std::string, 256> models;
    std::array<std::unique_ptr<FastPackets>, 256> fast_packets;  ///< by source
  };
  [[nodiscard]] Taken read(Bus& bus, const LogEntry& entry, Heard& heard);
  [[nodiscard]] static bool put_together(Bus& bus, const LogEntry& entry, Heard& heard);
  static void remember(Bus& bus, const Heard& heard);

  std::map<std::string, std::unique_ptr<Bus>> buses_;
  DecoderCounters counters_;
};

}  // namespace earshot::hil
