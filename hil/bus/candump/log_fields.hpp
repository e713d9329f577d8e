#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

#include "firmware/core/time.hpp"

namespace earshot::hil {

// What the lines of all recorders are made of.

/// The word at the beginning of the text, which moves behind it and the blanks on both sides.
[[nodiscard]] std::string_view take_word(std::string_view& text);

/// What stands before the next separator; the text moves behind that, or to its end.
[[nodiscard]] std::string_view take_field(std::string_view& text, char separator);

/// A whole number, and nothing beside it.
template <class T>
[[nodiscard]] std::optional<T> number(std::string_view text, int base = 10) {
  T value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "50": two hexadecimal digits.
[[nodiscard]] std::optional<std::uint8_t> byte(std::string_view digits);

/// "17.25" times 10^power, what is left behind the point left out; nothing for what is no decimal, or beyond 10^17.
[[nodiscard]] std::optional<std::int64_t> scaled(std::string_view decimal, unsigned power);

/// Year, month, day, hour, minute and second.
using DateParts = std::array<int, 6>;

/// Numbers where the shape has zeros, and else what it says: "0000-00-00 00:00:00". Nothing for another shape.
[[nodiscard]] std::optional<DateParts> date_parts(std::string_view text, std::string_view shape);

/// Of a date of this machine's zone. Nothing for none, or one before 1970.
[[nodiscard]] std::optional<Time> local_time(const DateParts& parts);
/// Of a date of UTC; before 1970 it is negative.
[[nodiscard]] std::optional<Time> utc_time(const DateParts& parts);

}  // namespace earshot::hil
