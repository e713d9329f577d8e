#include "firmware/safety/place_estimate.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"

namespace earshot::safety {
namespace {

constexpr Duration kMinute = Duration::seconds(60);
constexpr Duration kTenMinutes = Duration::seconds(600);
constexpr MetersPerSecond kSlowest{0.1};

bool is_known(MetersPerSecond speed) {
  return is_finite(speed.value);
}

NorthEast each_second(Radians heading, MetersPerSecond speed) {
  if (!is_known(speed)) return {};
  const SineCosine direction = sine_cosine(heading);
  return {.north = Meters{speed.value * direction.cosine}, .east = Meters{speed.value * direction.sine}};
}

NorthEast scaled(NorthEast way, double by) {
  return {.north = way.north * by, .east = way.east * by};
}

}  // namespace

void DriftWatch::begin(const messages::Navigation& fix) {
  newest_ = {.time = fix.time, .drift = fix.position, .uncertain = {}};
  position_ = fix.position;
  minute_ = {.older = newest_, .old = newest_};
  ten_minutes_ = minute_;
}

void DriftWatch::take(const messages::Navigation& fix, NorthEast explained, Meters uncertain) {
  newest_ = {.time = fix.time, .drift = newest_.drift + (fix.position - position_) - explained, .uncertain = newest_.uncertain + uncertain};
  position_ = fix.position;
  move_on(minute_, kMinute);
  move_on(ten_minutes_, kTenMinutes);
}

void DriftWatch::move_on(Window& window, Duration length) const {
  if (newest_.time - window.old.time < length) return;
  window.older = window.old;
  window.old = newest_;
}

Meters DriftWatch::unexplained_since(const Anchor& anchor, MetersPerSecond current) const {
  const Meters by_current{current.value * (newest_.time - anchor.time).to_seconds()};
  return range_between(anchor.drift, newest_.drift) - by_current - (newest_.uncertain - anchor.uncertain) - kNoise;
}

Meters DriftWatch::unexplained(MetersPerSecond current) const {
  return std::max({unexplained_since(minute_.older, current), unexplained_since(ten_minutes_.older, current), Meters{0.0}});
}

void PlaceEstimate::begin(const messages::Navigation& fix) {
  by_log_.begin(fix);
  by_order_.begin(fix);
  time_ = fix.time;
  each_second_ = each_second(fix.heading, fix.speed);
  ordered_.reset();
  ordered_speed_ = {};
  turning_s_ = 0.0;
}

void PlaceEstimate::take(const messages::Navigation& fix, const messages::Setpoint& setpoint, const config::VehicleLimits& vehicle) {
  const Duration apart = fix.time - time_;
  const double seconds = apart.to_seconds();
  const NorthEast now = each_second(fix.heading, fix.speed);
  const NorthEast way = scaled(each_second_ + now, 0.5 * seconds);
  const bool is_anywhere = !is_known(fix.speed) || apart > kFarApart;
  const Meters anywhere = is_anywhere ? Meters{vehicle.max_speed.value * seconds} : Meters{0.0};
  by_log_.take(fix, way, kShare * length_of(way) + anywhere);

  const bool may_have_stopped = apart > kUnheard && (!stopped_ || fix.time - *stopped_ >= kBetweenStops);
  if (may_have_stopped) {
    stopped_ = fix.time;
    ordered_.reset();
    ordered_speed_ = {};
  }
  const NorthEast ordered = scaled(each_second(setpoint.heading, setpoint.speed), seconds);
  const Meters uncertain = (may_have_stopped ? 1.0 : kShare) * length_of(ordered);
  by_order_.take(fix, ordered, uncertain + missed_way(setpoint, seconds, vehicle));
  each_second_ = now;
  time_ = fix.time;
}

void PlaceEstimate::correct(const messages::Navigation& fix) {
  by_log_.correct(fix);
  by_order_.correct(fix);
  each_second_ = each_second(fix.heading, fix.speed);
  time_ = fix.time;
}

/// While a vehicle turns, or comes to its speed, it goes another way than it is told: half a circle instead of straight back misses 3.7 of
/// its radii, of 3.1 that it sails, and a quarter 1.2 of 1.6.
Meters PlaceEstimate::missed_way(const messages::Setpoint& setpoint, double seconds, const config::VehicleLimits& vehicle) {
  constexpr double kMissed = 1.5;
  constexpr double kHalfTurn = 3.141592653589793;
  constexpr Meters kTightest{20.0};
  const double circle_s = std::max(vehicle.turn_radius, kTightest) / Meters{std::max(setpoint.speed, kSlowest).value};
  const double turn = ordered_ ? wrap_to_pi(setpoint.heading - *ordered_).value : kHalfTurn;
  const bool has_other_speed = !(setpoint.speed == ordered_speed_);
  turning_s_ += std::max(turn, -turn) * circle_s;
  if (has_other_speed) turning_s_ += kGathersWay.to_seconds();
  turning_s_ = std::min(turning_s_, kHalfTurn * circle_s + kGathersWay.to_seconds());
  const double turning_s = std::min(turning_s_, seconds);
  turning_s_ -= turning_s;
  ordered_ = setpoint.heading;
  ordered_speed_ = setpoint.speed;
  return Meters{kMissed * setpoint.speed.value * turning_s};
}

Meters PlaceEstimate::unexplained(const config::VehicleLimits& vehicle) const {
  const MetersPerSecond current = vehicle.max_current > MetersPerSecond{} ? vehicle.max_current : kAnyCurrent;
  return std::max(by_log_.unexplained(current), by_order_.unexplained(current));
}

}  // namespace earshot::safety
