#include "sim/search/account/numbers.hpp"

#include <cmath>

#include "firmware/host/text/numbers.hpp"

namespace earshot::search {

std::string geographic(double latitude_deg, double longitude_deg, const std::string& degrees) {
  return host::decimals(std::abs(latitude_deg), 3) + degrees + (latitude_deg < 0.0 ? " S, " : " N, ") +
         host::decimals(std::abs(longitude_deg), 3) + degrees + (longitude_deg < 0.0 ? " W" : " E");
}

}  // namespace earshot::search
