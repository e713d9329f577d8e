#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/math.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::messages {

/// Where the vehicle is, as its navigation says. Frame: the mission's north-east plane.
struct Navigation {
  Time time;  ///< when it was valid
  NorthEast position;
  Meters depth;           ///< positive down
  Radians heading;        ///< true, clockwise from north
  MetersPerSecond speed;  ///< through the water
  friend constexpr bool operator==(const Navigation&, const Navigation&) = default;
};

[[nodiscard]] inline bool is_finite(const Navigation& navigation) {
  return earshot::is_finite(navigation.position) && earshot::is_finite(navigation.depth.value) &&
         earshot::is_finite(navigation.heading.value) && earshot::is_finite(navigation.speed.value);
}

}  // namespace earshot::messages
