#include "firmware/host/text/numbers.hpp"

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

std::string counted(std::uint64_t count, std::string_view what) {
  return std::to_string(count) + " " + std::string(what) + (count == 1 ? "" : "s");
}

}  // namespace earshot::host
