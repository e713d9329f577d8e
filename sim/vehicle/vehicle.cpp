#include "sim/vehicle/vehicle.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"

namespace earshot::vehicle {
namespace {

double limited(double change, double limit) {
  return std::clamp(change, -limit, limit);
}

}  // namespace

State advance(const State& state, const Command& command, const Limits& limits, Duration step) {
  const double dt_s = step.to_seconds();
  const double turn = limited(wrap_to_pi(command.heading - state.heading).value, limits.turn_rate.value * dt_s);
  const double gain = std::min(1.0, dt_s / limits.speed_lag.to_seconds());
  const double speed_change = (command.speed - state.speed).value * gain;
  const double dive = limited((command.depth - state.depth).value, limits.depth_rate.value * dt_s);

  const Meters way{(state.speed.value + 0.5 * speed_change) * dt_s};
  const SineCosine middle = sine_cosine(Radians{state.heading.value + 0.5 * turn});
  return {.position = state.position + NorthEast{way * middle.cosine, way * middle.sine},
          .depth = state.depth + Meters{dive},
          .heading = wrap_to_pi(state.heading + Radians{turn}),
          .speed = state.speed + MetersPerSecond{speed_change}};
}

State advance_for(State state, const Command& command, const Limits& limits, Duration duration) {
  constexpr Duration kStep = Duration::milliseconds(100);
  while (duration > Duration{}) {
    const Duration step = std::min(duration, kStep);
    state = advance(state, command, limits, step);
    duration = duration - step;
  }
  return state;
}

}  // namespace earshot::vehicle
