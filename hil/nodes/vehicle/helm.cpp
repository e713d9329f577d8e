#include "hil/nodes/vehicle/helm.hpp"

#include <cmath>
#include <numbers>

namespace earshot::hil {
namespace {

/// What an autopilot of such a vehicle is built for; NaN is not.
bool is_steerable(const messages::Setpoint& setpoint) {
  constexpr MetersPerSecond kFastest{5.0};
  constexpr Meters kDeepest{11'000.0};
  return std::abs(setpoint.heading.value) <= 2.0 * std::numbers::pi && setpoint.speed >= MetersPerSecond{0.0} &&
         setpoint.speed <= kFastest && setpoint.depth >= Meters{0.0} && setpoint.depth <= kDeepest;
}

}  // namespace

void Helm::take(const messages::Setpoint& setpoint, Time now) {
  if (!is_engaged_ || !is_steerable(setpoint)) return;
  if (is_obedient_) command_ = {.heading = setpoint.heading, .speed = setpoint.speed, .depth = setpoint.depth};
  is_weight_released_ = is_weight_released_ || setpoint.release_weight;
  last_ = now;
  is_forsaken_ = false;
  ++taken_;
}

void Helm::step(Time now) {
  if (!is_engaged_ || !last_ || now - *last_ < kAutopilotPatience) return;
  command_.speed = MetersPerSecond{0.0};
  command_.depth = Meters{0.0};
  is_forsaken_ = true;
}

}  // namespace earshot::hil
