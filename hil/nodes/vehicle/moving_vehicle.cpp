#include "hil/nodes/vehicle/moving_vehicle.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "firmware/core/math.hpp"

namespace earshot::hil {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2.0;
/// Through the water: its propeller makes no more of any set-point, as of one whose bits the bus has changed.
constexpr MetersPerSecond kFastest{3.0};

}  // namespace

MovingVehicle::MovingVehicle(const vehicle::State& start, const vehicle::Limits& limits, Battery battery)
    : state_(start), reported_(start), over_floor_(start), place_(start.position), limits_(limits), battery_(battery) {}

void MovingVehicle::disturb(const Disturbance& disturbance) {
  disturbance_ = disturbance;
  battery_.percent = disturbance.battery_percent.value_or(battery_.percent);
}

/// What the hull does, whatever its autopilot wants.
vehicle::Command MovingVehicle::possible(vehicle::Command wanted) const {
  wanted.speed = std::clamp(wanted.speed, MetersPerSecond{0.0}, kFastest);
  if (disturbance_.has_no_thrust) wanted.speed = MetersPerSecond{0.0};
  if (disturbance_.are_planes_stuck || state_.speed < disturbance_.steerage_way) wanted.depth = state_.depth;
  if (disturbance_.is_rudder_stuck) {  // always a right angle ahead of it on the side to which it turns
    const double side = turning_.value > 0.0 ? 1.0 : (turning_.value < 0.0 ? -1.0 : 0.0);
    wanted.heading = wrap_to_pi(state_.heading + Radians{side * kRightAngle});
  }
  return wanted;
}

void MovingVehicle::move(Time now, const vehicle::Command& wanted) {
  const Time last = std::exchange(last_, now).value_or(now);
  const vehicle::State before = state_;
  state_ = vehicle::advance_for(state_, possible(wanted), limits_, now - last);
  const double seconds = (now - last).to_seconds();
  const Meters way = range_between(before.position, state_.position);
  if (!disturbance_.is_rudder_stuck && seconds > 0.0)
    turning_ = RadiansPerSecond{wrap_to_pi(state_.heading - before.heading).value / seconds};
  state_.position = state_.position + NorthEast{disturbance_.current_mps.north * seconds, disturbance_.current_mps.east * seconds};
  sailed_ += way;
  battery_.sail(way);
  update_reported();
}

void MovingVehicle::update_reported() {
  over_floor_ = state_;
  over_floor_.depth += disturbance_.floor_rise;
  if (disturbance_.is_frozen) return;
  if (!disturbance_.is_place_stuck) place_ = state_.position;
  reported_ = state_;
  reported_.position = place_ + disturbance_.position_error;
  reported_.speed = reported_.speed + disturbance_.speed_error;
  reported_.heading = wrap_to_pi(reported_.heading + disturbance_.heading_error);
  reported_.depth = disturbance_.stuck_depth.value_or(reported_.depth + disturbance_.depth_error);
}

}  // namespace earshot::hil
