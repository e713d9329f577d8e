#pragma once

#include <limits>

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/ranges.hpp"

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

/// Whether it says where the vehicle is: all of it is in its range, but for a speed that is not known.
[[nodiscard]] constexpr bool is_usable(const Navigation& navigation) {
  const double speed = navigation.speed.value;
  const bool is_unknown = speed != speed;  // NaN
  return kPlace_m.contains(navigation.position.north.value) && kPlace_m.contains(navigation.position.east.value) &&
         kDepth_m.contains(navigation.depth.value) && kHeading_rad.contains(navigation.heading.value) &&
         (is_unknown || kSpeed_mps.contains(speed));
}

}  // namespace earshot::messages
