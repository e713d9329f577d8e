#include "firmware/boards/linux/messages.hpp"

#include <algorithm>

namespace earshot::board {

nav_state_t to_message(const runtime::Navigation& navigation) {
  nav_state_t m{};
  m.utime = navigation.time.us;
  m.north_m = navigation.position.north.value;
  m.east_m = navigation.position.east.value;
  m.depth_m = navigation.depth.value;
  m.heading_rad = navigation.heading.value;
  m.speed_mps = navigation.speed.value;
  return m;
}

snr_estimate_t to_message(const runtime::SnrEstimate& estimate) {
  snr_estimate_t m{};
  m.utime = estimate.time.us;
  m.snr_db = estimate.snr.value;
  m.too_faint = estimate.measured ? 0 : 1;
  return m;
}

operator_command_t to_message(runtime::OperatorCommand command, Time now) {
  operator_command_t m{};
  m.utime = now.us;
  m.command = static_cast<std::int8_t>(command);
  return m;
}

setpoint_t to_message(const runtime::Setpoint& setpoint, Time now) {
  setpoint_t m{};
  m.utime = now.us;
  m.heading_rad = setpoint.heading.value;
  m.speed_mps = setpoint.speed.value;
  m.depth_m = setpoint.depth.value;
  m.waypoint_north_m = setpoint.waypoint.north.value;
  m.waypoint_east_m = setpoint.waypoint.east.value;
  return m;
}

decision_t to_message(const runtime::Decision& decision) {
  decision_t m{};
  m.utime = decision.time.us;
  m.step = static_cast<std::int32_t>(decision.step);
  m.north_m = decision.position.north.value;
  m.east_m = decision.position.east.value;
  m.snr_db = decision.snr.value;
  m.too_faint = decision.measured ? 0 : 1;
  m.detected = decision.detected ? 1 : 0;
  m.action = static_cast<std::int8_t>(decision.action);
  m.overridden = decision.overridden ? 1 : 0;
  m.waypoint_north_m = decision.waypoint.north.value;
  m.waypoint_east_m = decision.waypoint.east.value;
  m.observation_size = static_cast<std::int8_t>(decision.observation_size);
  m.action_count = static_cast<std::int8_t>(decision.action_count);
  std::copy(decision.observation.begin(), decision.observation.end(), std::begin(m.observation));
  std::copy(decision.logits.begin(), decision.logits.end(), std::begin(m.logits));
  m.believes = decision.belief ? 1 : 0;
  if (decision.belief) {
    m.likeliest_north_m = decision.belief->likeliest.north.value;
    m.likeliest_east_m = decision.belief->likeliest.east.value;
    m.mean_north_m = decision.belief->mean.north.value;
    m.mean_east_m = decision.belief->mean.east.value;
    m.spread_m = decision.belief->spread.value;
    m.likeliest_share = decision.belief->likeliest_share;
    m.effective_cells = decision.belief->effective_cells;
  }
  return m;
}

health_t to_message(const runtime::Outputs& outputs, std::uint64_t bus_refused, Time now) {
  health_t m{};
  m.utime = now.us;
  m.state = static_cast<std::int8_t>(outputs.state);
  m.end_reason = static_cast<std::int8_t>(outputs.end_reason);
  m.steps_taken = static_cast<std::int32_t>(outputs.steps_taken);
  m.navigation_refused = static_cast<std::int32_t>(outputs.counters.navigation_refused);
  m.snr_refused = static_cast<std::int32_t>(outputs.counters.snr_refused);
  m.commands_refused = static_cast<std::int32_t>(outputs.counters.commands_refused);
  m.setpoints_limited = static_cast<std::int32_t>(outputs.counters.setpoints_limited);
  m.bus_refused = static_cast<std::int64_t>(bus_refused);
  return m;
}

runtime::Navigation from_message(const nav_state_t& m) {
  return {.time = {m.utime},
          .position = {Meters{m.north_m}, Meters{m.east_m}},
          .depth = Meters{m.depth_m},
          .heading = Radians{m.heading_rad},
          .speed = MetersPerSecond{m.speed_mps}};
}

runtime::SnrEstimate from_message(const snr_estimate_t& m) {
  return {.time = {m.utime}, .snr = Decibels{m.snr_db}, .measured = m.too_faint == 0};
}

runtime::OperatorCommand from_message(const operator_command_t& m) {
  return static_cast<runtime::OperatorCommand>(m.command);
}

}  // namespace earshot::board
