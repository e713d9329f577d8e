#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/wire/n2k/signals.hpp"

namespace earshot::hil {

/// What one field of a message says.
struct Value {
  enum class Kind : std::uint8_t {
    kNumber,  ///< also of a closed list, where it has no word: newer devices know newer words
    kWord,    ///< of a closed list
    kText,    ///< what a device says of itself; any bytes
    kNotAvailable,
    kOutOfRange,  ///< the sender says so
    kReserved,    ///< a raw value that the standard keeps for later
    kNotAllowed,  ///< a number that the standard does not allow: `number` is it
    kUnreadable,  ///< text of an unknown encoding, or that contradicts its own length
    kMissing,     ///< the message ended before
  };
  std::string name;  ///< of a field that a message repeats: with its number, "PGN[1]", from the second on
  std::string_view unit{};
  Kind kind = Kind::kNumber;
  double number = 0.0;
  std::string text{};
  friend bool operator==(const Value&, const Value&) = default;
};

/// Every field of a message.
/// @param bytes  of the whole message
/// Oracle: Value tests on recorded buses, read by canboat
[[nodiscard]] std::vector<Value> values_of(const n2k::Message& message, std::span<const std::uint8_t> bytes);

/// In words of one line: "2.3152 rad (132.65 deg)", "Magnetic", "not available".
[[nodiscard]] std::string to_string(const Value& value);

/// The same without the unit.
[[nodiscard]] std::string without_unit(const Value& value);

}  // namespace earshot::hil
