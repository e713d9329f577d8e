#include "hil/nodes/vehicle/helm.hpp"

namespace earshot::hil {

void Helm::take(const messages::Setpoint& setpoint, Time now) {
  if (!is_engaged_) return;
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
