#include "firmware/host/text/numbers.hpp"

#include <cstdarg>
#include <cstdio>
#include <system_error>

namespace earshot::host {

std::string decimals(double number, int places) {
  std::array<char, 400> digits{};  // 1.8e308 written out has 309
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed, places);
  return error == std::errc{} ? std::string(digits.data(), end) : "?";
}

std::string significant(double number, int digits) {
  return formatted("%.*g", digits, number);
}

std::string formatted(const char* format, ...) {
  std::va_list values;
  va_start(values, format);
  std::va_list again;
  va_copy(again, values);
  const int size = std::vsnprintf(nullptr, 0, format, values);
  va_end(values);
  std::string text(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  (void)std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

std::string counted(std::uint64_t count, std::string_view what, std::string_view plural) {
  std::string text = std::to_string(count) + " ";
  if (count == 1) return text.append(what);
  return plural.empty() ? text.append(what) + "s" : text.append(plural);
}

}  // namespace earshot::host
