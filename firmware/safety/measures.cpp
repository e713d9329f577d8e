#include "firmware/safety/measures.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"
#include "firmware/safety/fence.hpp"

namespace earshot::safety {
namespace {

using config::Condition;

constexpr double kDegreesPerRadian = 57.29577951308232;

double size_of(double x) {
  return x < 0.0 ? -x : x;
}

double seconds_since(Time date, Time now) {
  return now > date ? (now - date).to_seconds() : 0.0;
}

/// Of a sender that may never have been heard.
template <class Message>
double age_s(const std::optional<Message>& newest, const Situation& situation) {
  return seconds_since(newest ? newest->time : situation.search_began, situation.now);
}

std::optional<double> known(double value) {
  return is_finite(value) ? std::optional(value) : std::nullopt;
}

/// How much deeper the vehicle is going to be.
double sinking_m(const Situation& situation) {
  const MetersPerSecond rate = situation.track.sink_rate();
  return rate > kKeepsDepth ? rate.value * kForesight.to_seconds() : 0.0;
}

std::optional<double> altitude_m(const Situation& situation) {
  if (!situation.vehicle) return std::nullopt;
  return known(situation.vehicle->altitude.value - sinking_m(situation));
}

std::optional<double> battery_percent(const Situation& situation) {
  return situation.vehicle ? known(situation.vehicle->battery_percent) : std::nullopt;
}

std::optional<double> battery_at_home_percent(const config::Mission& mission, const Situation& situation) {
  const config::Safety& safety = mission.safety;
  const std::optional<double> charge = battery_percent(situation);
  if (!charge || !safety.safe_point) return std::nullopt;
  const Meters way = range_between(situation.navigation.newest()->position, *safety.safe_point);
  const double way_km = against_current(mission, way).value * 1e-3;
  return *charge - way_km * safety.vehicle.battery_percent_per_km;
}

double outside_halt_m(const config::Mission& mission, NorthEast position) {
  if (mission.safety.fence) return beyond(mission.safety.fence->halt, position).value;
  return std::max(-mission.operating_area.distance_to_edge(position).value, 0.0);
}

/// While a vehicle is steered back it is beyond the fence until it is inside and no longer on its way out.
double outside_fence_m(const config::Safety& safety, const Situation& situation) {
  if (!safety.fence) return 0.0;
  const NorthEast position = situation.navigation.newest()->position;
  const double soon_m = beyond(safety.fence->save, place_after_turning(safety.vehicle, situation)).value;
  const double now_m = beyond(situation.is_steered_back ? safety.fence->inside : safety.fence->save, position).value;
  return std::max(now_m, soon_m);
}

/// A vehicle that goes round is always a quarter of a turn behind its set-point: it follows as long as it turns.
std::optional<double> heading_ignored_deg(const Situation& situation) {
  constexpr RadiansPerSecond kTurns{0.5 / kDegreesPerRadian};
  if (!situation.commanded) return std::nullopt;
  if (situation.goes_round && situation.track.turn_rate() >= kTurns) return 0.0;
  return size_of(wrap_to_pi(situation.navigation.newest()->heading - situation.commanded->heading).value) * kDegreesPerRadian;
}

std::optional<double> depth_ignored_m(const Situation& situation) {
  if (!situation.commanded) return std::nullopt;
  return size_of((situation.navigation.newest()->depth - situation.commanded->depth).value);
}

double as_number(bool flag) {
  return flag ? 1.0 : 0.0;
}

}  // namespace

Meters against_current(const config::Mission& mission, Meters way) {
  const MetersPerSecond made_good = mission.search_speed - mission.safety.vehicle.max_current;
  return way * (mission.search_speed / made_good);
}

std::optional<double> measure(Condition condition, const config::Mission& mission, const Situation& situation) {
  const messages::Navigation& fix = *situation.navigation.newest();
  const config::Safety& safety = mission.safety;
  switch (condition) {
    case Condition::kNavigationAge:
      return seconds_since(fix.time, situation.now);
    case Condition::kNavigationJump:
      return situation.navigation.jump(situation.now).value;
    case Condition::kNavigationFrozen:
      return situation.navigation.frozen().to_seconds();
    case Condition::kSnrAge:
      return seconds_since(situation.snr, situation.now);
    case Condition::kVehicleStatusAge:
      return age_s(situation.vehicle, situation);
    case Condition::kAutopilotAge:
      return age_s(situation.autopilot, situation);
    case Condition::kOperatorAge:
      return seconds_since(situation.operator_heard.value_or(situation.search_began), situation.now);
    case Condition::kOutsideFence:
      return outside_fence_m(safety, situation);
    case Condition::kOutsideHalt:
      return outside_halt_m(mission, fix.position);
    case Condition::kDepth:
      return fix.depth.value + sinking_m(situation);
    case Condition::kAltitude:
      return altitude_m(situation);
    case Condition::kSpeed:
      return known(fix.speed.value);
    case Condition::kTurnRate:
      return situation.track.turn_rate().value * kDegreesPerRadian;
    case Condition::kSearchTime:
      return seconds_since(situation.search_began, situation.now);
    case Condition::kDistanceTravelled:
      return situation.track.distance().value;
    case Condition::kBattery:
      return battery_percent(situation);
    case Condition::kBatteryAtHome:
      return battery_at_home_percent(mission, situation);
    case Condition::kLeak:
      return situation.vehicle ? std::optional(as_number(situation.vehicle->has_leak)) : std::nullopt;
    case Condition::kGroundFault:
      return situation.vehicle ? std::optional(as_number(situation.vehicle->has_ground_fault)) : std::nullopt;
    case Condition::kHydrophoneDeaf:
      return situation.hydrophone ? std::optional(as_number(situation.hydrophone->is_deaf)) : std::nullopt;
    case Condition::kAutopilotDisengaged:
      return situation.autopilot ? std::optional(as_number(!situation.autopilot->follows_setpoints)) : std::nullopt;
    case Condition::kHeadingIgnored:
      return heading_ignored_deg(situation);
    case Condition::kDepthIgnored:
      return depth_ignored_m(situation);
    case Condition::kNoProgress:
      return situation.track.without_progress(situation.now).to_seconds();
    case Condition::kPolicyUnhealthy:
      return as_number(situation.is_policy_unhealthy);
    case Condition::kNavigationDisputed:
      return situation.navigation.dispute(situation.now).value;
    case Condition::kPlaceUnexplained:
      return situation.place.unexplained(safety.vehicle).value;
    case Condition::kDepthUnexplained:
      return situation.depth.unexplained().value;
    case Condition::kSetpointsUnsent:
      return situation.mute_since ? seconds_since(*situation.mute_since, situation.now) : 0.0;
  }
  return std::nullopt;
}

}  // namespace earshot::safety
