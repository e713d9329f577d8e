#include "firmware/safety/fence.hpp"

#include "firmware/core/math.hpp"
#include "firmware/core/polygon.hpp"

namespace earshot::safety {
namespace {

constexpr double kHalfPi = 1.5707963267948966;

/// Slower than this, a vehicle has no way of its own.
constexpr MetersPerSecond kStandstill{0.1};

/// Over ground, per second: as the fixes say, or as heading and speed do while there are too few.
NorthEast velocity_of(const config::VehicleLimits& vehicle, const Situation& situation) {
  if (situation.track.velocity_per_s()) return *situation.track.velocity_per_s();
  const messages::Navigation& fix = *situation.navigation.newest();
  const MetersPerSecond speed = is_finite(fix.speed.value) ? fix.speed : vehicle.max_speed;
  const SineCosine heading = sine_cosine(fix.heading);
  return {.north = Meters{speed.value * heading.cosine}, .east = Meters{speed.value * heading.sine}};
}

}  // namespace

Meters beyond(const config::Polygon& polygon, NorthEast place) {
  if (contains(polygon.span(), place)) return Meters{0.0};
  return range_between(nearest_on_edges(polygon.span(), place), place);
}

NorthEast place_after_turning(const config::VehicleLimits& vehicle, const Situation& situation) {
  const NorthEast position = situation.navigation.newest()->position;
  const NorthEast velocity = velocity_of(vehicle, situation);
  const Meters each_second = length_of(velocity);
  if (!(each_second.value > kStandstill.value)) return position;
  const MetersPerSecond own = situation.navigation.newest()->speed;
  const double turns_at_mps = own.value > each_second.value ? own.value : each_second.value;  // over ground where its own is not known
  const double turning_s = kHalfPi * vehicle.turn_radius.value / turns_at_mps;
  const Meters way = each_second * kReaction.to_seconds() + vehicle.turn_radius + Meters{vehicle.max_current.value * turning_s};
  const double share = way / each_second;
  return position + NorthEast{.north = velocity.north * share, .east = velocity.east * share};
}

NorthEast nearest_within(const config::Polygon& polygon, NorthEast place) {
  return contains(polygon.span(), place) ? place : nearest_on_edges(polygon.span(), place);
}

}  // namespace earshot::safety
