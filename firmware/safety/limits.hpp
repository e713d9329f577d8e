#pragma once

#include "firmware/config/mission.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/setpoint.hpp"

namespace earshot::safety {

// The last word over policy and guidance: nothing they say reaches the autopilot but through here.

struct SafeWaypoint {
  NorthEast waypoint;
  bool overridden = false;  ///< it is not the one the policy wanted
};

/// The nearest way-point to the wanted one that keeps edge_margin from the edge of the operating area. Where that leaves less than half a
/// step to go (the policy pushes against the edge), one step towards the middle of the area instead, so that every decision moves the
/// vehicle; so too if the wanted way-point is not finite. That step keeps edge_margin as well, from wherever the vehicle is.
/// @param mission  one that config::check accepts
[[nodiscard]] SafeWaypoint safe_waypoint(const config::Mission& mission, NorthEast position, NorthEast wanted);

struct SafeSetpoint {
  messages::Setpoint setpoint;
  bool limited = false;  ///< it is not the one guidance wanted
};

/// Depth kept within [0, max_depth] and speed within [0, search_speed] or what the vehicle needs to come up; come_up() if anything is not
/// finite.
[[nodiscard]] SafeSetpoint safe_setpoint(const config::Mission& mission, const messages::Navigation& fix, const messages::Setpoint& wanted,
                                         Duration unseen);

/// The set-point that says stop and come up, as the vehicle can: straight up, heading and place kept, or round and round at the speed that
/// it needs until it is at the surface. It is sent in DONE and ABORT, and in place of one that is not finite.
///
/// A vehicle that goes round is told a quarter of a turn from where it points. When fixes cease or freeze nobody knows where it points: the
/// heading it is told then turns on by itself,
///
///   heading = heading of the fix + pi/2 + v t / blind_radius
///
/// t: how long it was unseen (Situation::unseen), v: ascent speed. It stops once `is_up`, which no depth alone decides (DepthEstimate).
[[nodiscard]] messages::Setpoint come_up(const config::Mission& mission, const messages::Navigation& fix, Duration unseen, bool is_up);

/// Whether a set-point sends the vehicle round and round: a quarter of a turn to the right of where it points.
[[nodiscard]] bool goes_round(const messages::Navigation& fix, const messages::Setpoint& setpoint);

/// Of the circle on which a vehicle is sent up that cannot be seen: twice as wide as its tightest, and 20 m where that is not known.
[[nodiscard]] Meters blind_radius(Meters turn_radius);

}  // namespace earshot::safety
