#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"

namespace earshot::n2k {

// One table says what every message on the bus looks like. Encoding and decoding run on it, and the DBC file for candump, cantools and
// SavvyCAN users is printed from it (earshot dbc).

/// One field: value = raw * scale + offset, raw little-endian from bit `first_bit` (bit 0 of byte 0 is bit 0).
/// The highest raw values are no numbers (special_values).
struct Signal {
  enum class Sign : std::uint8_t { kUnsigned, kSigned };
  std::string_view name;
  std::uint16_t first_bit = 0;
  std::uint8_t bit_count = 0;  ///< 1..32
  Sign sign = Sign::kUnsigned;
  double scale = 1.0;
  double offset = 0.0;
  std::string_view unit;
  double lowest = 0.0;   ///< smallest value the standard allows, in `unit`
  double highest = 0.0;  ///< largest
};

enum class Direction : std::uint8_t { kToRuntime, kFromRuntime };

/// One parameter group: which it is, how often it comes, after how long its value is too old.
struct Message {
  std::string_view name;
  std::uint32_t pgn = 0;
  std::uint8_t priority = 0;  ///< default
  std::uint8_t size = 8;      ///< bytes; over 8: a fast packet
  Direction direction = Direction::kToRuntime;
  Duration period;   ///< at which it is sent
  Duration timeout;  ///< ten periods: older is stale
  std::span<const Signal> signals;
};

inline constexpr std::size_t kMaxMessageSize = 24;  ///< bytes; Heading/Track Control is the largest with 21; full: does not compile

inline constexpr std::uint32_t kHeadingPgn = 127250;
inline constexpr std::uint32_t kPositionPgn = 129025;
inline constexpr std::uint32_t kSpeedPgn = 128259;
inline constexpr std::uint32_t kPressurePgn = 130314;
inline constexpr std::uint32_t kHeadingControlPgn = 127237;
inline constexpr std::uint32_t kSpeedDepthPgn = 65290;

/// Every message Earshot reads or writes.
[[nodiscard]] std::span<const Message> messages();

/// Null if the table has no such message or signal.
[[nodiscard]] const Message* find_message(std::uint32_t pgn);
[[nodiscard]] const Signal* find_signal(const Message& message, std::string_view name);

/// The highest raw values are no numbers; the topmost, all ones but for the sign bit, says "not available".
[[nodiscard]] std::int64_t not_available(const Signal& signal);

/// How many of the highest raw values are no numbers: 1 below four bits (not available), 2 below eight (and out of range), else 3 (and
/// reserved).
[[nodiscard]] std::int64_t special_values(const Signal& signal);

/// kNotReady: the field says "not available". kOutOfRange: "out of range", reserved, or a value the standard does not allow. kMalformed:
/// too few bytes.
[[nodiscard]] Result<double> decode(const Signal& signal, std::span<const std::uint8_t> bytes);

/// Writes the nearest raw value. kOutOfRange, and nothing written, if `value` is not finite or not in [lowest, highest]. kFull: too few
/// bytes.
[[nodiscard]] Status encode(const Signal& signal, double value, std::span<std::uint8_t> bytes);

/// Bytes of a message all of whose fields are "not available" and whose reserved bits are one; the first message.size of them count.
[[nodiscard]] std::array<std::uint8_t, kMaxMessageSize> blank(const Message& message);

}  // namespace earshot::n2k
