#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"

namespace earshot::messages {

/// What the autopilot is asked to do.
struct Setpoint {
  Radians heading;              ///< true, clockwise from north, in (-pi, pi]
  MetersPerSecond speed;        ///< through the water
  Meters depth;                 ///< positive down
  NorthEast waypoint;           ///< end of the leg
  bool release_weight = false;  ///< the mission was aborted by a rule that asks for the drop weight to be released
  friend constexpr bool operator==(const Setpoint&, const Setpoint&) = default;
};

}  // namespace earshot::messages
