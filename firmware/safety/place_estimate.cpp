#include "firmware/safety/place_estimate.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"

namespace earshot::safety {
namespace {

constexpr Duration kMinute = Duration::seconds(60);
constexpr Duration kTenMinutes = Duration::seconds(600);

bool is_known(MetersPerSecond speed) {
  return is_finite(speed.value);
}

NorthEast each_second(const messages::Navigation& fix) {
  if (!is_known(fix.speed)) return {};
  const SineCosine heading = sine_cosine(fix.heading);
  return {.north = Meters{fix.speed.value * heading.cosine}, .east = Meters{fix.speed.value * heading.sine}};
}

}  // namespace

void PlaceEstimate::begin(const messages::Navigation& fix) {
  newest_ = {.time = fix.time, .drift = fix.position, .way = {}};
  position_ = fix.position;
  each_second_ = each_second(fix);
  minute_ = {.older = newest_, .old = newest_};
  ten_minutes_ = minute_;
}

void PlaceEstimate::take(const messages::Navigation& fix, const config::VehicleLimits& vehicle) {
  const double seconds = (fix.time - newest_.time).to_seconds();
  const NorthEast now = each_second(fix);
  const NorthEast both = each_second_ + now;
  const NorthEast way{.north = both.north * (0.5 * seconds), .east = both.east * (0.5 * seconds)};
  newest_.drift = newest_.drift + (fix.position - position_) - way;
  newest_.way += length_of(way);
  const bool is_anywhere = !is_known(fix.speed) || fix.time - newest_.time > kFarApart;
  if (is_anywhere) newest_.way += Meters{vehicle.max_speed.value * seconds / kShare};
  newest_.time = fix.time;
  position_ = fix.position;
  each_second_ = now;
  move_on(minute_, kMinute);
  move_on(ten_minutes_, kTenMinutes);
}

void PlaceEstimate::move_on(Window& window, Duration length) const {
  if (newest_.time - window.old.time < length) return;
  window.older = window.old;
  window.old = newest_;
}

Meters PlaceEstimate::unexplained_since(const Anchor& anchor, MetersPerSecond current) const {
  const Meters by_current{current.value * (newest_.time - anchor.time).to_seconds()};
  const Meters by_error = kShare * (newest_.way - anchor.way);
  return range_between(anchor.drift, newest_.drift) - by_current - by_error - kNoise;
}

Meters PlaceEstimate::unexplained(const config::VehicleLimits& vehicle) const {
  const MetersPerSecond current = vehicle.max_current > MetersPerSecond{} ? vehicle.max_current : kAnyCurrent;
  return std::max({unexplained_since(minute_.older, current), unexplained_since(ten_minutes_.older, current), Meters{0.0}});
}

}  // namespace earshot::safety
