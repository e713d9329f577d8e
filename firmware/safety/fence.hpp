#pragma once

#include "firmware/config/safety.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/safety/situation.hpp"

namespace earshot::safety {

/// How far a place lies beyond a polygon; zero within it.
[[nodiscard]] Meters beyond(const config::Polygon& polygon, NorthEast place);

/// The outermost place of the vehicle's way if it began to turn round now: what it covers over ground until its rudder acts, its turning
/// circle, and the drift of the current while it turns through a right angle.
///
///   way = v_g t + R + c (pi/2) R / v,   t = kReaction, along the way over ground
///
/// v_g: speed over ground, v: that or the speed through the water, whichever is more: a vehicle that hardly gets on against a current
/// turns as fast as in still water. c: strongest current, R: turn radius. A current that carries the vehicle on drifts it for longer than
/// that, as its own speed is less than v_g: margin_to_halt leaves room for it.
/// @pre the situation has a fix
[[nodiscard]] NorthEast place_after_turning(const config::VehicleLimits& vehicle, const Situation& situation);

/// The nearest place of the polygon; `place` itself from within it.
[[nodiscard]] NorthEast nearest_within(const config::Polygon& polygon, NorthEast place);

/// Between two turns of the loop, from a set-point to the rudder, and until the next fix.
inline constexpr Duration kReaction = Duration::seconds(3);

}  // namespace earshot::safety
