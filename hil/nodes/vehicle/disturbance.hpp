#pragma once

#include <optional>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/wire/n2k/own/conditions.hpp"

namespace earshot::hil {

/// What is wrong with a hydrophone.
struct HydrophoneFault {
  bool is_deaf = false;  ///< it says so (65291), and no SNR
  Decibels gain_error;   ///< of the SNR that it tells
};

/// What is wrong with a vehicle and its instruments: nothing, unless it is told.
struct Disturbance {
  // Of the vehicle.
  NorthEast current_mps = {};                  ///< metres a second that the water carries it over ground
  bool is_rudder_stuck = false;                ///< it keeps turning as it turned when this began; straight ahead if it went straight
  bool are_planes_stuck = false;               ///< it keeps its depth
  bool has_no_thrust = false;                  ///< its propeller stands still
  bool is_disengaged = false;                  ///< its autopilot follows no set-point, and says so
  bool is_obstinate = false;                   ///< its autopilot follows no set-point, and says that it does
  MetersPerSecond steerage_way = {};           ///< slower than this through the water it keeps its depth
  std::optional<double> battery_percent = {};  ///< what is left from now on; it goes on to fall
  n2k::Hull hull{.instance = 0, .wet = false, .has_ground_fault = false};
  Meters floor_rise = {};  ///< of the sea floor above its chart
  // Of what its instruments tell.
  bool is_frozen = false;  ///< compass, log, depth sensor and navigation go on telling what they told
  NorthEast position_error = {};
  Radians heading_error = {};  ///< a magnetic compass that calls its north true: minus the variation
  Meters depth_error = {};
  MetersPerSecond speed_error = {};
  bool is_place_stuck = false;             ///< but for `position_error`
  std::optional<Meters> stuck_depth = {};  ///< what the depth sensor says
  HydrophoneFault hydrophone = {};
};

}  // namespace earshot::hil
