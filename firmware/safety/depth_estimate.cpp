#include "firmware/safety/depth_estimate.hpp"

#include <algorithm>

namespace earshot::safety {
namespace {

constexpr Meters kSurface{0.0};
constexpr Meters kFall{1.0};
/// Of its depth, that a vehicle may go on down while it turns up.
constexpr double kTurnsUpWithin = 0.1;

Meters between(Meters a, Meters b) {
  return a < b ? b - a : a - b;
}

/// From one depth towards another.
Meters moved(Meters from, Meters to, double seconds, MetersPerSecond up) {
  if (to > from) return std::min(to, from + Meters{DepthEstimate::kFastestSink.value * seconds});
  return std::max(to, from - Meters{up.value * seconds});
}

}  // namespace

void DepthEstimate::tell(Time now, const messages::Setpoint& setpoint, const config::VehicleLimits& vehicle) {
  const bool was_left_alone = is_left_alone(now);
  if (was_left_alone) told_speed_ = MetersPerSecond{};  // nobody knows that it came up meanwhile
  if (told_at_) pass(now - *told_at_, vehicle);
  if (!told_at_ || was_left_alone || !(told_ == setpoint.depth)) {
    allowed_ = std::max(allowed_, between(depth_, setpoint.depth) + kOff);
    turning_ = kToTurn;
  }
  told_at_ = now;
  told_ = setpoint.depth;
  told_speed_ = setpoint.speed;
  if (told_ > kSurface) {
    comes_up_ = false;
    is_up_ = false;
  } else if (!comes_up_) {
    comes_up_ = true;
    deepest_ = deepest_ + std::min(kOff, deepest_ * kTurnsUpWithin);
    deepest_of_slow_ = deepest_;
    shallowest_ = depth_;
    fell_at_ = now;
  }
  if (comes_up_) look(now, vehicle);
}

/// It did for so long what it was told. One that is told to stop goes no deeper, and up only where it floats up.
void DepthEstimate::pass(Duration time, const config::VehicleLimits& vehicle) {
  const double seconds = time.to_seconds();
  const bool comes_up = told_speed_ >= vehicle.ascent_speed;
  deepest_ = moved(deepest_, told_, seconds, comes_up ? vehicle.ascent_rate : MetersPerSecond{});
  deepest_of_slow_ = moved(deepest_of_slow_, told_, seconds, comes_up ? config::kSlowestAscent : MetersPerSecond{});
  if (!(told_speed_ > MetersPerSecond{}) && !(comes_up && told_ < depth_)) return;
  if (turning_ > Duration{}) {
    turning_ = turning_ - time;
  } else {
    allowed_ = std::max(kOff, allowed_ - Meters{kSlowestDive.value * seconds});
  }
}

void DepthEstimate::take(const messages::Navigation& fix, const config::VehicleLimits& vehicle) {
  before_ = told_at_ ? depth_ : fix.depth;
  depth_ = fix.depth;
  if (!told_at_) {
    deepest_ = deepest_of_slow_ = std::max(depth_, kSurface);
  } else if (comes_up_) {
    look(std::max(fix.time, *told_at_), vehicle);
  } else {
    deepest_ = std::max(deepest_, std::min(depth_, before_));
    deepest_of_slow_ = std::max(deepest_of_slow_, deepest_);
  }
}

void DepthEstimate::look(Time now, const config::VehicleLimits& vehicle) {
  const Meters seen = std::min(depth_, before_);
  if (depth_ <= shallowest_ - kFall) {
    shallowest_ = depth_;
    fell_at_ = now;
  }
  if (seen > std::max(shallowest_, vehicle.surface_depth) + kSinksAgain && (is_up_ || seen > deepest_)) start_anew(now);
  const bool had_time = !(deepest_of_slow_ > kSurface) && now - fell_at_ >= kLongestHalt;
  is_up_ = is_up_ || had_time || is_up(vehicle);
}

/// From where its depth says that it is now.
void DepthEstimate::start_anew(Time now) {
  deepest_ = std::max(deepest_, std::min(depth_, before_));
  deepest_of_slow_ = std::max(deepest_of_slow_, deepest_);
  shallowest_ = depth_;
  fell_at_ = now;
  is_up_ = false;
}

bool DepthEstimate::is_up(const config::VehicleLimits& vehicle) const {
  return is_up_ || (!(deepest_ > kSurface) && depth_ <= vehicle.surface_depth);
}

Meters DepthEstimate::unexplained() const {
  return told_at_ ? std::max(between(depth_, told_) - allowed_, kSurface) : kSurface;
}

}  // namespace earshot::safety
