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
Meters moved(Meters from, Meters to, Meters down, Meters up) {
  return to > from ? std::min(to, from + down) : std::max(to, from - up);
}

}  // namespace

void DepthEstimate::note_order(Time now, const messages::Setpoint& setpoint, const config::VehicleLimits& vehicle) {
  const bool was_left_alone = is_left_alone(now);
  if (was_left_alone) ordered_speed_ = MetersPerSecond{};  // nobody knows that it came up meanwhile
  if (!comes_up_) {
    deepest_ = std::max(deepest_, std::min(depth_, before_));
    deepest_of_slow_ = std::max(deepest_of_slow_, deepest_);
  }
  if (ordered_at_) pass(now - *ordered_at_, vehicle);
  if (!ordered_at_ || was_left_alone || !(ordered_depth_ == setpoint.depth)) {
    allowed_ = std::max(allowed_, between(depth_, setpoint.depth) + kOff);
    turning_ = kToTurn;
    turn_up(vehicle);
  }
  ordered_at_ = now;
  ordered_depth_ = setpoint.depth;
  ordered_speed_ = setpoint.speed;
  if (ordered_depth_ > kSurface) {
    comes_up_ = false;
    is_up_ = false;
  } else if (!comes_up_) {
    comes_up_ = true;
    deepest_ = while_it_turns_up(deepest_);
    deepest_of_slow_ = deepest_;
    shallowest_ = depth_;
    fell_at_ = now;
  }
  if (comes_up_) check_ascent(now, vehicle);
}

/// From now on, and no less deep for as long as it takes: but where it is at the surface already.
void DepthEstimate::turn_up(const config::VehicleLimits& vehicle) {
  turning_up_ = deepest_ > vehicle.surface_depth ? kToTurn : Duration{};
}

/// It did for so long what it was told. One that is told to stop goes no deeper, and up only where it floats up.
void DepthEstimate::pass(Duration time, const config::VehicleLimits& vehicle) {
  const double seconds = time.to_seconds();
  const bool comes_up = ordered_speed_ >= vehicle.ascent_speed;
  const Duration turns = comes_up ? std::min(turning_up_, time) : Duration{};
  turning_up_ = turning_up_ - turns;
  const double rises_s = comes_up ? (time - turns).to_seconds() : 0.0;
  const Meters down{kFastestSink.value * seconds};
  deepest_ = moved(deepest_, ordered_depth_, down, Meters{vehicle.ascent_rate.value * rises_s});
  deepest_of_slow_ = moved(deepest_of_slow_, ordered_depth_, down, Meters{config::kSlowestAscent.value * rises_s});
  if (!(ordered_speed_ > MetersPerSecond{}) && !(comes_up && ordered_depth_ < depth_)) return;
  if (turning_ > Duration{}) {
    turning_ = turning_ - time;
  } else {
    allowed_ = std::max(kOff, allowed_ - Meters{kSlowestDive.value * seconds});
  }
}

void DepthEstimate::take(const messages::Navigation& fix) {
  before_ = ordered_at_ ? depth_ : fix.depth;
  if (fixed_at_) {
    const Meters rises{kFastestSink.value * std::max((fix.time - *fixed_at_).to_seconds(), 0.0)};
    if (fix.depth < depth_ - rises - kFall) flickered_at_ = fix.time;
  }
  fixed_at_ = fix.time;
  depth_ = fix.depth;
  if (!ordered_at_) deepest_ = deepest_of_slow_ = std::max(depth_, kSurface);
}

void DepthEstimate::check_ascent(Time now, const config::VehicleLimits& vehicle) {
  const Meters seen = std::min(depth_, before_);
  const bool sinks = seen > std::max(shallowest_, vehicle.surface_depth) + kSinksAgain;
  if (sinks) deepest_ = std::max(deepest_, seen);
  if (is_up_) return check_ascent_again(now, sinks, vehicle);
  if (depth_ <= shallowest_ - kFall) {
    shallowest_ = depth_;
    fell_at_ = now;
  }
  const bool had_time = !(deepest_of_slow_ > kSurface) && now - fell_at_ >= kLongestHalt;
  rests_ = !is_up(vehicle);
  is_up_ = had_time || !rests_;
  stopped_at_ = now;
}

/// One that sinks from the surface comes up again at once. What says all the time that it is below may be a depth that lies, or a vehicle
/// under ice or in a line: that rests, and tries again. So does one whose depth falls faster than vehicles rise: it lies now and then.
void DepthEstimate::check_ascent_again(Time now, bool sinks, const config::VehicleLimits& vehicle) {
  const bool reads_up = std::max(depth_, before_) <= vehicle.surface_depth;
  if (rests_ && reads_up && !(deepest_ > kSurface)) {
    rests_ = false;
    shallowest_ = depth_;
  }
  if (sinks && flickered_at_ && now - *flickered_at_ < kRest) rests_ = true;
  const bool tries = rests_ && now - stopped_at_ >= kRest && std::min(depth_, before_) > vehicle.surface_depth;
  if (!tries && (rests_ || !sinks)) return;
  if (!rests_) deepest_of_slow_ = std::max(deepest_of_slow_, deepest_);
  shallowest_ = depth_;
  fell_at_ = now;
  is_up_ = false;
  turn_up(vehicle);
}

bool DepthEstimate::is_up(const config::VehicleLimits& vehicle) const {
  return is_up_ || (!(deepest_ > kSurface) && depth_ <= vehicle.surface_depth);
}

Meters DepthEstimate::while_it_turns_up(Meters depth) {
  return depth + std::min(kOff, depth * kTurnsUpWithin);
}

Meters DepthEstimate::unexplained() const {
  return ordered_at_ ? std::max(between(depth_, ordered_depth_) - allowed_, kSurface) : kSurface;
}

}  // namespace earshot::safety
