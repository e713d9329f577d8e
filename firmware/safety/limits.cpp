#include "firmware/safety/limits.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"

namespace earshot::safety {
namespace {

constexpr Radians kQuarterTurn{1.5707963267948966};

NorthEast clamped_into(const Rectangle& area, NorthEast place) {
  return {.north = std::clamp(place.north, area.south_west.north, area.north_east.north),
          .east = std::clamp(place.east, area.south_west.east, area.north_east.east)};
}

/// One step towards the middle of the area, or the middle itself when it is nearer. From beyond the margin of a long area such a step may
/// end beyond it, as the middle lies far along it: then it goes across to the margin, which is further than a step.
NorthEast inwards(const config::Mission& mission, const Rectangle& allowed, NorthEast position) {
  const NorthEast diagonal = mission.operating_area.north_east - mission.operating_area.south_west;
  const NorthEast middle = mission.operating_area.south_west + NorthEast{.north = diagonal.north * 0.5, .east = diagonal.east * 0.5};
  const NorthEast way = middle - position;
  const Meters distance = length_of(way);
  if (distance <= mission.step_length) return middle;
  const double share = mission.step_length / distance;
  return clamped_into(allowed, position + NorthEast{.north = way.north * share, .east = way.east * share});
}

}  // namespace

SafeWaypoint safe_waypoint(const config::Mission& mission, NorthEast position, NorthEast wanted) {
  const Rectangle within_margin = mission.operating_area.moved_in(mission.edge_margin);
  if (!is_finite(wanted)) return {.waypoint = inwards(mission, within_margin, position), .overridden = true};
  const NorthEast allowed = clamped_into(within_margin, wanted);
  if (allowed == wanted) return {.waypoint = wanted, .overridden = false};
  const bool goes_on = range_between(position, allowed) >= 0.5 * mission.step_length;
  return {.waypoint = goes_on ? allowed : inwards(mission, within_margin, position), .overridden = true};
}

SafeSetpoint safe_setpoint(const config::Mission& mission, const messages::Navigation& fix, const messages::Setpoint& wanted,
                           Duration unseen) {
  const bool finite =
      is_finite(wanted.heading.value) && is_finite(wanted.speed.value) && is_finite(wanted.depth.value) && is_finite(wanted.waypoint);
  if (!finite) return {.setpoint = come_up(mission, fix, unseen, false), .limited = true};
  messages::Setpoint allowed = wanted;
  allowed.depth = std::clamp(wanted.depth, Meters{0.0}, mission.max_depth);
  allowed.speed = std::clamp(wanted.speed, MetersPerSecond{0.0}, std::max(mission.search_speed, mission.safety.vehicle.ascent_speed));
  return {.setpoint = allowed, .limited = !(allowed == wanted)};
}

Meters blind_radius(Meters turn_radius) {
  return std::max(2.0 * turn_radius, Meters{20.0});
}

messages::Setpoint come_up(const config::Mission& mission, const messages::Navigation& fix, Duration unseen, bool is_up) {
  const config::VehicleLimits& vehicle = mission.safety.vehicle;
  const bool must_move = vehicle.ascent_speed.value > 0.0 && !is_up;
  const Radians turned_on{vehicle.ascent_speed.value / blind_radius(vehicle.turn_radius).value * unseen.to_seconds()};
  return {.heading = wrap_to_pi(must_move ? fix.heading + kQuarterTurn + turned_on : fix.heading),
          .speed = must_move ? vehicle.ascent_speed : MetersPerSecond{0.0},
          .depth = Meters{0.0},
          .waypoint = fix.position};
}

bool goes_round(const messages::Navigation& fix, const messages::Setpoint& setpoint) {
  constexpr Radians kRounding{1e-9};
  const Radians off = wrap_to_pi(setpoint.heading - fix.heading - kQuarterTurn);
  return off < kRounding && off > -1.0 * kRounding;
}

}  // namespace earshot::safety
