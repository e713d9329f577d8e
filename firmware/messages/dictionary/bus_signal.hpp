#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "firmware/config/capacities.hpp"

namespace earshot::n2k {

// A field on the CAN bus: NMEA 2000's way to lay a number out, and short words to write one with. firmware/wire/n2k reads and writes them.

/// Names and units are for who reads a bus; a microcontroller, where nobody does, has no room for them: 10 KiB.
inline constexpr bool kHasWords =
    config::kProfile == config::Profile::kVehicleComputer || config::kProfile == config::Profile::kRoomyMicrocontroller;
struct NoWords {
  constexpr NoWords() = default;
  constexpr NoWords(std::string_view /*words*/) {}  // NOLINT(google-explicit-constructor): in a string's place
};
using Words = std::conditional_t<kHasWords, std::string_view, NoWords>;

/// By which a name is found where names themselves are not kept: FNV-1a.
constexpr std::uint32_t key_of(std::string_view name) {
  std::uint32_t key = 2'166'136'261U;
  for (const char c : name) key = (key ^ static_cast<std::uint8_t>(c)) * 16'777'619U;
  return key;
}

/// The name of one raw value: a word of a closed list, as "Magnetic" of a heading's reference.
struct Choice {
  std::int64_t raw = 0;
  std::uint32_t key = 0;
  [[no_unique_address]] Words name{};

  consteval Choice(std::int64_t value, std::string_view called) : raw(value), key(key_of(called)), name(called) {}
};

struct NoChoices {
  constexpr NoChoices() = default;
  constexpr NoChoices(std::span<const Choice> /*choices*/) {}  // NOLINT(google-explicit-constructor): in a span's place
  [[nodiscard]] static constexpr bool empty() { return true; }
};
using Choices = std::conditional_t<kHasWords, std::span<const Choice>, NoChoices>;

/// value = raw * numerator / denominator: of whole numbers, so that a raw value below 2^53 becomes the double nearest to its decimal.
struct Scale {
  double numerator = 1.0;
  double denominator = 1.0;
};

/// One field: raw little-endian from bit `first_bit` (bit 0 of byte 0 is bit 0). The highest raw values are no numbers (special_count).
struct Signal {
  enum class Sign : std::uint8_t { kUnsigned, kSigned };
  enum class Kind : std::uint8_t {
    kNumber,
    kFixedText,     ///< characters in a place of fixed size, padded
    kVariableText,  ///< size, encoding, characters; the n-th such text of a message (first_bit = n) lies behind those before it
  };
  std::uint32_t key = 0;  ///< key_of(name), no other's of the message
  std::uint16_t first_bit = 0;
  std::uint16_t bit_count = 0;  ///< of a number 1..64, unsigned 1..63
  Sign sign = Sign::kUnsigned;
  Kind kind = Kind::kNumber;
  std::uint8_t special_count = 0;
  Words name{};
  Words unit{};
  Scale scale{};
  double lowest = 0.0;           ///< smallest value the standard allows, in `unit`
  double highest = 0.0;          ///< largest
  std::int64_t lowest_raw = 0;   ///< likewise, raw, to the nearest: the highest angle on the bus, 62832 * 1e-4 rad, is a hair over 2 pi
  std::int64_t highest_raw = 0;  ///< likewise
  [[no_unique_address]] Choices choices{};  ///< empty: a plain number

  /// The highest raw value that the bits of a number can hold; "not available" if special_count is not 0.
  [[nodiscard]] constexpr std::int64_t top() const {
    return static_cast<std::int64_t>(~std::uint64_t{0} >> (64U - bit_count + (sign == Sign::kSigned ? 1U : 0U)));
  }
};

namespace table {

using enum Signal::Sign;

inline constexpr double kPi = 3.141592653589793;
inline constexpr double kTwoPi = 6.283185307179586;

inline constexpr Scale kOne{1, 1};
inline constexpr Scale kTenth{1, 10};
inline constexpr Scale kHundredth{1, 100};
inline constexpr Scale kThousandth{1, 1000};
inline constexpr Scale kTenThousandth{1, 10'000};

enum class Special : std::uint8_t {
  kUsual,  ///< the highest raw value says "not available", the next "out of range", a third is reserved
  kNone,   ///< every raw value is a number
};

/// Whole number nearest to x, |x| < 2^63.
consteval std::int64_t nearest(double x) {
  return static_cast<std::int64_t>(x < 0.0 ? x - 0.5 : x + 0.5);
}

/// How many of the highest raw values are no numbers: 1 below four bits (not available), 2 below eight (and out of range), else 3 (and
/// reserved).
consteval std::uint8_t usual_special_count(unsigned bit_count) {
  if (bit_count >= 8) return 3;
  return bit_count >= 4 ? 2 : 1;
}

/// A field that may hold all of its numbers.
consteval Signal number(std::string_view name, unsigned first_bit, unsigned bit_count, Signal::Sign sign = kUnsigned, Scale scale = kOne,
                        std::string_view unit = "", Special special = Special::kUsual) {
  Signal signal{.key = key_of(name),
                .first_bit = static_cast<std::uint16_t>(first_bit),
                .bit_count = static_cast<std::uint16_t>(bit_count),
                .sign = sign,
                .name = name,
                .unit = unit,
                .scale = scale};
  if (special == Special::kUsual) signal.special_count = usual_special_count(bit_count);
  signal.highest_raw = signal.top() - signal.special_count;
  signal.lowest_raw = sign == kSigned ? -signal.top() : 0;
  signal.lowest = static_cast<double>(signal.lowest_raw) * scale.numerator / scale.denominator;
  signal.highest = static_cast<double>(signal.highest_raw) * scale.numerator / scale.denominator;
  return signal;
}

/// A field whose numbers the standard confines to [lowest, highest].
consteval Signal within(double lowest, double highest, Signal signal) {
  signal.lowest = lowest;
  signal.highest = highest;
  signal.lowest_raw = nearest(lowest * signal.scale.denominator / signal.scale.numerator);
  signal.highest_raw = nearest(highest * signal.scale.denominator / signal.scale.numerator);
  return signal;
}

consteval Signal choice(std::string_view name, unsigned first_bit, unsigned bit_count, std::span<const Choice> choices,
                        Special special = Special::kUsual) {
  Signal signal = number(name, first_bit, bit_count, kUnsigned, kOne, "", special);
  signal.choices = choices;
  return signal;
}

/// Clockwise, 1e-4 rad, [0, 2 pi].
consteval Signal direction(std::string_view name, unsigned first_bit) {
  return within(0.0, kTwoPi, number(name, first_bit, 16, kUnsigned, kTenThousandth, "rad"));
}

/// 1e-4 rad, [-pi, pi].
consteval Signal angle(std::string_view name, unsigned first_bit) {
  return within(-kPi, kPi, number(name, first_bit, 16, kSigned, kTenThousandth, "rad"));
}

/// Days since 1970-01-01.
consteval Signal date(std::string_view name, unsigned first_bit) {
  return number(name, first_bit, 16, kUnsigned, kOne, "d");
}

/// Seconds since midnight UTC, a leap second and one more allowed for.
consteval Signal time_of_day(std::string_view name, unsigned first_bit) {
  return within(0.0, 86'401.0, number(name, first_bit, 32, kUnsigned, kTenThousandth, "s"));
}

/// Counts what belongs together: messages of one instant bear the same.
consteval Signal sequence_identifier(unsigned first_bit) {
  return number("SID", first_bit, 8);
}

consteval Signal fixed_text(std::string_view name, unsigned first_bit, unsigned bytes) {
  return {.key = key_of(name),
          .first_bit = static_cast<std::uint16_t>(first_bit),
          .bit_count = static_cast<std::uint16_t>(8 * bytes),
          .kind = Signal::Kind::kFixedText,
          .name = name};
}

consteval Signal variable_text(std::string_view name, unsigned index) {
  return {.key = key_of(name), .first_bit = static_cast<std::uint16_t>(index), .kind = Signal::Kind::kVariableText, .name = name};
}

// Of Earshot's own messages.

/// Microseconds since the epoch of the mission clock (UTC at sea).
consteval Signal instant(std::string_view name, unsigned first_bit) {
  return number(name, first_bit, 64, kSigned, {1, 1'000'000}, "s");
}
/// Drawn or counted by a sender: all 32 bits are numbers.
consteval Signal any_number(std::string_view name, unsigned first_bit) {
  return number(name, first_bit, 32, kUnsigned, kOne, "", Special::kNone);
}
/// What only grows: 9 years at a million a second; more stays at the highest.
consteval Signal counter(std::string_view name, unsigned first_bit) {
  return number(name, first_bit, 48);
}
consteval Signal metres(std::string_view name, unsigned first_bit) {
  return number(name, first_bit, 32, kSigned, kHundredth, "m");
}

}  // namespace table
}  // namespace earshot::n2k
