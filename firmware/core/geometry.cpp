#include "firmware/core/geometry.hpp"

#include "firmware/core/math.hpp"

namespace earshot {

Meters length_of(NorthEast displacement) {
  const double north = displacement.north.value;
  const double east = displacement.east.value;
  return Meters{sqrt(north * north + east * east)};
}

Meters range_between(NorthEast a, NorthEast b) {
  return length_of(b - a);
}

}  // namespace earshot
