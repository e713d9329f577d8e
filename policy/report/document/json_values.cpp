#include "policy/report/document/json_values.hpp"

#include <array>
#include <cmath>

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

}  // namespace earshot::report
