#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace earshot::host {

/// "12.35" of two decimals; "nan" and "inf" as they are.
[[nodiscard]] std::string decimals(double number, int places);

/// "35400", "0.25", "1e+30": at most so many significant digits, without zeros behind them.
[[nodiscard]] std::string significant(double number, int digits);

/// The shortest digits that read back as the same number.
template <class Number>
requires std::integral<Number> || std::floating_point<Number>
[[nodiscard]] std::string shortest(Number number) {
  std::array<char, 32> digits{};
  const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return {digits.data(), written.ptr};
}

/// "1 record", "12 records"; "2 processes" where the plural is given.
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view what, std::string_view plural = "");

/// What std::printf would print; the compiler compares the format with what follows it.
[[nodiscard, gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

}  // namespace earshot::host
