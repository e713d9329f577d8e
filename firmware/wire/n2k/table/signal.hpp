#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "firmware/core/time.hpp"
#include "firmware/messages/dictionary/bus_signal.hpp"

namespace earshot::n2k {

inline constexpr std::size_t kMaxMessageSize = 223;  ///< bytes, of a fast packet by the standard; full: does not compile

enum class Direction : std::uint8_t { kToRuntime, kFromRuntime, kBoth };

/// How a message goes over the bus.
enum class Framing : std::uint8_t {
  kSingle,     ///< one frame
  kFast,       ///< fast packet
  kTransport,  ///< ISO 11783 transport protocol, broadcast
};

/// One parameter group: which it is, how often it comes, after how long its value is too old.
struct Message {
  Words name{};
  std::uint32_t pgn = 0;
  std::uint8_t priority = 0;  ///< default
  std::uint8_t size = 8;      ///< bytes; of a message that repeats or holds variable text: the least
  Framing framing = Framing::kSingle;
  Direction direction = Direction::kToRuntime;
  Duration period{};    ///< at which it is sent; zero: when somebody asks, or something happens
  Duration timeout{};   ///< ten periods: older is stale
  Duration handover{};  ///< two and a half periods: of a device that is silent for longer another takes the place
  std::span<const Signal> signals{};
  std::uint8_t repeated_bytes = 0;  ///< the last so many bytes come once or more
  std::uint8_t kind = 0;            ///< of Earshot's own messages that share a PGN: which; 0: the PGN says it all
};

namespace table {

consteval Duration ten_times(Duration period) {
  return {10 * period.us};
}

consteval Duration two_and_a_half_times(Duration period) {
  return {5 * period.us / 2};
}

/// Never defined: a constant expression that calls it does not compile.
void there_is_no_such_name();

/// A number for who needs nothing else of the message: a reference to it would bring its fields, with their names, into the program.
consteval Duration handover_of(const Message& message) {
  return message.handover;
}
consteval Duration timeout_of(const Message& message) {
  return message.timeout;
}

/// The field of that name; does not compile if the message has none.
consteval Signal field(const Message& message, std::string_view name) {
  for (const Signal& signal : message.signals) {
    if (signal.key == key_of(name)) return signal;
  }
  there_is_no_such_name();
  return {};
}

/// The raw value of that name; does not compile if the field has none.
consteval std::int64_t raw_of(std::span<const Choice> choices, std::string_view name) {
  for (const Choice& choice : choices) {
    if (choice.key == key_of(name)) return choice.raw;
  }
  there_is_no_such_name();
  return 0;
}

}  // namespace table
}  // namespace earshot::n2k
