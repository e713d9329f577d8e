#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::vehicle {

/// How the vehicle can move. Defaults: a torpedo-shaped AUV of a few metres at 2 m/s (turning circle of 19 m radius).
struct Limits {
  RadiansPerSecond turn_rate{0.10471975511965977};  ///< 6 degrees per second
  Duration speed_lag = Duration::seconds(5);        ///< time constant of the speed towards its set-point
  MetersPerSecond depth_rate{0.5};
};

/// Where the vehicle is. Frame: the mission's north-east plane.
struct State {
  NorthEast position;
  Meters depth;     ///< positive down
  Radians heading;  ///< clockwise from north, in (-pi, pi]
  MetersPerSecond speed;
};

/// What its autopilot is told.
struct Command {
  Radians heading;
  MetersPerSecond speed;
  Meters depth;
};

/// The state after one `step` (at most a fraction of a second) of a vehicle that moves along its heading through still water.
///
///   heading' = towards the command by the shorter way, at most turn_rate
///   speed'   = (command - speed) / speed_lag
///   depth'   = towards the command, at most depth_rate
///   position' = speed (cos heading, sin heading), heading and speed taken at the middle of the step
///
/// Same bits on every machine. There is no current, no roll or pitch, and depth does not change the horizontal speed.
[[nodiscard]] State advance(const State& state, const Command& command, const Limits& limits, Duration step);

/// The state after `duration`, in steps of 0.1 s (the last may be shorter).
[[nodiscard]] State advance_for(State state, const Command& command, const Limits& limits, Duration duration);

}  // namespace earshot::vehicle
