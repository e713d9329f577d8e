#include "firmware/safety/manoeuvre.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"
#include "firmware/core/polygon.hpp"
#include "firmware/safety/fence.hpp"
#include "firmware/safety/limits.hpp"

namespace earshot::safety {
namespace {

constexpr Radians kQuarterTurn{1.5707963267948966};
/// From so near to the save polygon's edge the way to it is no direction.
constexpr Meters kAtEdge{1.0};
/// A place is reached from this far, or from the width of a turning circle.
constexpr Meters kNear{20.0};

Radians bearing_from(NorthEast from, NorthEast to) {
  const NorthEast way = to - from;
  return bearing_of(way.north.value, way.east.value);
}

const config::Polygon* zone_at(const config::Safety& safety, NorthEast place) {
  for (const config::Polygon& zone : safety.no_surface) {
    if (contains(zone.span(), place)) return &zone;
  }
  return nullptr;
}

/// Where a vehicle beyond the fence, or about to be, should go.
NorthEast place_inside(const config::Mission& mission, const Situation& situation) {
  const config::Polygon& inside = mission.safety.fence->inside;
  return nearest_within(inside, place_after_turning(mission.safety.vehicle, situation));
}

/// Beyond the save polygon straight to it, so that the vehicle makes way against whatever carries it out: in an acute corner the nearest
/// place inside lies far along the edge.
NorthEast way_back(const config::Fence& fence, NorthEast position) {
  const NorthEast saved = nearest_within(fence.save, position);
  return range_between(position, saved) > kAtEdge ? saved : nearest_within(fence.inside, position);
}

}  // namespace

messages::Setpoint Manoeuvre::setpoint(const config::Mission& mission, const Situation& situation, config::Response response) {
  const bool steers_back = situation.is_steered_back || response <= config::Response::kSteerBack;
  if (!steers_back) side_ = Side::kNone;  // the next time that it is beyond the fence is another
  switch (response) {
    case config::Response::kWarn:
    case config::Response::kSteerBack:
      return steer_back(mission, situation);
    case config::Response::kHold:
      return situation.is_steered_back ? steer_back(mission, situation) : hold(mission, situation);
    case config::Response::kReturn:
      if (situation.is_steered_back) return steer_back(mission, situation);
      return mission.safety.safe_point ? stay_at(mission, situation, *mission.safety.safe_point) : hold(mission, situation);
    case config::Response::kSurface:
      return surface(mission, situation);
    case config::Response::kAbort:
      break;
    case config::Response::kRelease: {
      messages::Setpoint setpoint = come_up_from(mission, situation);
      setpoint.release_weight = true;
      return setpoint;
    }
  }
  return come_up_from(mission, situation);
}

/// Of a turn by more than a right angle: to where the vehicle's circle lies less far beyond the fence. In a corner the shorter way round
/// may lead out.
Manoeuvre::Side Manoeuvre::open_side(const config::Mission& mission, const messages::Navigation& fix, Radians error) {
  const Side shorter = error.value < 0.0 ? Side::kLeft : Side::kRight;
  const Meters across = 2.0 * mission.safety.vehicle.turn_radius;
  const SineCosine heading = sine_cosine(fix.heading);
  const NorthEast to_the_right{.north = across * -heading.sine, .east = across * heading.cosine};
  const Meters beyond_right = beyond(mission.safety.fence->save, fix.position + to_the_right);
  const Meters beyond_left = beyond(mission.safety.fence->save, fix.position - to_the_right);
  if (beyond_right == beyond_left) return shorter;
  return beyond_right < beyond_left ? Side::kRight : Side::kLeft;
}

/// A quarter of a turn ahead at the most, always round the side of the first, however the nearest way back may change, until no more than
/// that is left to either side. Then the turn is over, and the next has a side of its own: kept for longer, it would lead the long way
/// round, and out, when the way back has changed by a little.
Radians Manoeuvre::by_way_of_its_side(const config::Mission& mission, const messages::Navigation& fix, Radians wanted) {
  const Radians error = wrap_to_pi(wanted - fix.heading);
  if (error <= kQuarterTurn && error >= -1.0 * kQuarterTurn) {
    side_ = Side::kNone;
    return wanted;
  }
  if (side_ == Side::kNone) side_ = open_side(mission, fix, error);
  return wrap_to_pi(fix.heading + static_cast<double>(side_) * kQuarterTurn);
}

messages::Setpoint Manoeuvre::steer_back(const config::Mission& mission, const Situation& situation) {
  if (!mission.safety.fence) return hold(mission, situation);
  const messages::Navigation& fix = *situation.navigation.newest();
  const NorthEast position = fix.position;
  const NorthEast goal = nearest_within(mission.safety.fence->inside, position);
  const bool is_inside = goal == position;
  const Radians wanted = is_inside ? bearing_from(place_after_turning(mission.safety.vehicle, situation), place_inside(mission, situation))
                                   : bearing_from(position, way_back(*mission.safety.fence, position));
  return {.heading = by_way_of_its_side(mission, fix, wanted),
          .speed = mission.search_speed,
          .depth = mission.search_depth,
          .waypoint = is_inside ? place_inside(mission, situation) : goal};
}

/// A vehicle that cannot hover goes there again and again.
messages::Setpoint Manoeuvre::stay_at(const config::Mission& mission, const Situation& situation, NorthEast place) const {
  const messages::Navigation& fix = *situation.navigation.newest();
  const config::VehicleLimits& vehicle = mission.safety.vehicle;
  const bool is_there = range_between(fix.position, place) <= std::max(kNear, 2.0 * vehicle.turn_radius);
  const bool hovers = is_there && vehicle.hold_speed.value == 0.0;
  const Radians round = wrap_to_pi(fix.heading + kQuarterTurn);
  Radians heading = bearing_from(fix.position, place);
  if (is_there) heading = hovers ? wrap_to_pi(fix.heading) : round;
  return {
      .heading = heading, .speed = is_there ? vehicle.hold_speed : mission.search_speed, .depth = mission.search_depth, .waypoint = place};
}

messages::Setpoint Manoeuvre::hold(const config::Mission& mission, const Situation& situation) {
  if (!holding_) holding_ = situation.navigation.newest()->position;
  return stay_at(mission, situation, *holding_);
}

messages::Setpoint Manoeuvre::come_up_from(const config::Mission& mission, const Situation& situation) {
  return come_up(mission, *situation.navigation.newest(), situation.unseen(), situation.depth.is_up(mission.safety.vehicle));
}

messages::Setpoint Manoeuvre::surface(const config::Mission& mission, const Situation& situation) {
  const messages::Navigation& fix = *situation.navigation.newest();
  const config::Polygon* zone = zone_at(mission.safety, fix.position);
  if (zone == nullptr || fix.depth <= mission.safety.vehicle.surface_depth) return come_up_from(mission, situation);
  const NorthEast edge = nearest_on_edges(zone->span(), fix.position);
  const NorthEast way = edge - fix.position;
  return {.heading = edge == fix.position ? wrap_to_pi(fix.heading) : bearing_of(way.north.value, way.east.value),
          .speed = mission.search_speed,
          .depth = std::min(mission.search_depth, fix.depth),
          .waypoint = edge};
}

}  // namespace earshot::safety
