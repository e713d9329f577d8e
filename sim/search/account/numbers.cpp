#include "sim/search/account/numbers.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace earshot::search {

std::string decimals(double value, int places) {
  std::array<char, 64> text{};
  (void)std::snprintf(text.data(), text.size(), "%.*f", places, value);
  return text.data();
}

std::string geographic(double latitude_deg, double longitude_deg, const std::string& degrees) {
  return decimals(std::abs(latitude_deg), 3) + degrees + (latitude_deg < 0.0 ? " S, " : " N, ") + decimals(std::abs(longitude_deg), 3) +
         degrees + (longitude_deg < 0.0 ? " W" : " E");
}

}  // namespace earshot::search
