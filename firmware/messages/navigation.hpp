#pragma once

#include <limits>

#include "firmware/core/geometry.hpp"
#include "firmware/core/math.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::messages {

/// Of a vehicle that has no log, or whose log is silent.
inline constexpr MetersPerSecond kUnknownSpeed{std::numeric_limits<double>::quiet_NaN()};

/// Where the vehicle is, as its navigation says. Frame: the mission's north-east plane.
struct Navigation {
  Time time;  ///< when it was valid
  NorthEast position;
  Meters depth;           ///< positive down
  Radians heading;        ///< true, clockwise from north
  MetersPerSecond speed;  ///< through the water; any NaN: not known
  friend constexpr bool operator==(const Navigation&, const Navigation&) = default;
};

/// Whether it says where the vehicle is: all of it is finite, but for a speed that is not known. Nothing steers by the speed.
[[nodiscard]] inline bool is_usable(const Navigation& navigation) {
  const double speed = navigation.speed.value;
  const bool is_unknown = speed != speed;  // NaN
  return earshot::is_finite(navigation.position) && earshot::is_finite(navigation.depth.value) &&
         earshot::is_finite(navigation.heading.value) && (is_unknown || earshot::is_finite(speed));
}

}  // namespace earshot::messages
