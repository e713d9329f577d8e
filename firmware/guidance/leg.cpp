#include "firmware/guidance/leg.hpp"

#include "firmware/core/math.hpp"

namespace earshot::guidance {

Leg::Leg(NorthEast start, NorthEast waypoint) : start_(start), waypoint_(waypoint) {
  const double north = (waypoint - start).north.value;
  const double east = (waypoint - start).east.value;
  length_ = range_between(start, waypoint);
  if (length_.value > 0.0) direction_ = {.north = north / length_.value, .east = east / length_.value};
  bearing_ = bearing_of(direction_.north, direction_.east);
}

Meters Leg::along_track(NorthEast position) const {
  const NorthEast from_start = position - start_;
  return from_start.north * direction_.north + from_start.east * direction_.east;
}

Meters Leg::cross_track(NorthEast position) const {
  const NorthEast from_start = position - start_;
  return from_start.east * direction_.north - from_start.north * direction_.east;
}

Radians Leg::heading_to_steer(NorthEast position) const {
  const Radians correction = bearing_of(kLookahead.value, -cross_track(position).value);
  return wrap_to_pi(bearing_ + correction);
}

}  // namespace earshot::guidance
