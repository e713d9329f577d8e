#include "policy/report/document/json_values.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include "firmware/core/compass.hpp"

namespace earshot::report {

nlohmann::ordered_json rounded(double x, int decimals) {
  constexpr std::array kScales{1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6};
  constexpr double kMostWhole = 9e15;  // a double tells whole numbers apart up to there
  if (!std::isfinite(x)) return nullptr;
  const double scale = kScales.at(static_cast<std::size_t>(decimals));
  const double value = std::round(x * scale) / scale;
  if (value == std::trunc(value) && std::abs(value) < kMostWhole) return static_cast<std::int64_t>(value);
  return value;
}

nlohmann::ordered_json rounded_compass(double degrees) {
  constexpr double kRoundsToAFullTurn = 359.95;
  return rounded(degrees >= kRoundsToAFullTurn ? 0.0 : degrees, 1);
}

nlohmann::ordered_json compass_value(Radians direction) {
  return rounded_compass(compass_degrees(direction));
}

nlohmann::ordered_json place_value(NorthEast place) {
  return {{"north_m", rounded(place.north.value, 1)}, {"east_m", rounded(place.east.value, 1)}};
}

std::string json_text(const nlohmann::ordered_json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8U | (k < count ? bytes[i + k] : 0U);
    for (std::size_t digit = 0; digit < 4; ++digit) text += digit <= count ? kDigits[group >> (18U - 6U * digit) & 63U] : '=';
  }
  return text;
}

}  // namespace earshot::report
