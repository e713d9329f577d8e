#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/core/time.hpp"

namespace earshot::n2k {

/// The name of one raw value: a word of a closed list, as "Magnetic" of a heading's reference.
struct Choice {
  std::int64_t raw = 0;
  std::string_view name{};
};

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
  std::string_view name{};
  std::uint16_t first_bit = 0;
  std::uint16_t bit_count = 0;  ///< of a number 1..64, unsigned 1..63
  Sign sign = Sign::kUnsigned;
  Kind kind = Kind::kNumber;
  Scale scale{};
  std::string_view unit{};
  double lowest = 0.0;           ///< smallest value the standard allows, in `unit`
  double highest = 0.0;          ///< largest
  std::int64_t lowest_raw = 0;   ///< likewise, raw, to the nearest: the highest angle on the bus, 62832 * 1e-4 rad, is a hair over 2 pi
  std::int64_t highest_raw = 0;  ///< likewise
  std::int64_t top = 0;          ///< highest raw value that the bits can hold; "not available" if special_count is not 0
  std::int64_t special_count = 0;
  std::span<const Choice> choices{};  ///< empty: a plain number
};

enum class Direction : std::uint8_t { kToRuntime, kFromRuntime, kBoth };

/// How a message goes over the bus.
enum class Framing : std::uint8_t {
  kSingle,     ///< one frame
  kFast,       ///< fast packet
  kTransport,  ///< ISO 11783 transport protocol, broadcast
};

/// One parameter group: which it is, how often it comes, after how long its value is too old.
struct Message {
  std::string_view name{};
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
consteval std::int64_t usual_special_count(unsigned bit_count) {
  if (bit_count >= 8) return 3;
  return bit_count >= 4 ? 2 : 1;
}

/// A field that may hold all of its numbers.
consteval Signal number(std::string_view name, unsigned first_bit, unsigned bit_count, Signal::Sign sign = kUnsigned, Scale scale = kOne,
                        std::string_view unit = "", Special special = Special::kUsual) {
  Signal signal{.name = name,
                .first_bit = static_cast<std::uint16_t>(first_bit),
                .bit_count = static_cast<std::uint16_t>(bit_count),
                .sign = sign,
                .scale = scale,
                .unit = unit};
  signal.top = static_cast<std::int64_t>(~std::uint64_t{0} >> (64U - bit_count + (sign == kSigned ? 1U : 0U)));
  signal.special_count = special == Special::kUsual ? usual_special_count(bit_count) : 0;
  signal.highest_raw = signal.top - signal.special_count;
  signal.lowest_raw = sign == kSigned ? -signal.top : 0;
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
  return {.name = name,
          .first_bit = static_cast<std::uint16_t>(first_bit),
          .bit_count = static_cast<std::uint16_t>(8 * bytes),
          .kind = Signal::Kind::kFixedText};
}

consteval Signal variable_text(std::string_view name, unsigned index) {
  return {.name = name, .first_bit = static_cast<std::uint16_t>(index), .kind = Signal::Kind::kVariableText};
}

consteval Duration ten_times(Duration period) {
  return {10 * period.us};
}

consteval Duration two_and_a_half_times(Duration period) {
  return {5 * period.us / 2};
}

/// Never defined: a constant expression that calls it does not compile.
void there_is_no_such_name();

/// The field of that name; does not compile if the message has none.
consteval Signal field(const Message& message, std::string_view name) {
  for (const Signal& signal : message.signals) {
    if (signal.name == name) return signal;
  }
  there_is_no_such_name();
  return {};
}

/// The raw value of that name; does not compile if the field has none.
consteval std::int64_t raw_of(std::span<const Choice> choices, std::string_view name) {
  for (const Choice& choice : choices) {
    if (choice.name == name) return choice.raw;
  }
  there_is_no_such_name();
  return 0;
}

}  // namespace table
}  // namespace earshot::n2k
