#include "firmware/wire/lcm/conversion.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>

#include "firmware/wire/lcm/safety_conversion.hpp"

namespace earshot::wire {
namespace {

/// Of a limit that a command leaves as it is.
constexpr double kNotSaid = std::numeric_limits<double>::quiet_NaN();

// What `verified` says; nobody but a port's own program does.
constexpr std::int8_t kVerified = 1;
constexpr std::int8_t kOldMark = 2;

template <class Limit>
std::optional<Limit> if_said(double limit) {
  return limit == limit ? std::optional(Limit{limit}) : std::nullopt;
}

std::optional<Radians> axis_if(bool is_ambiguous, double axis_rad) {
  return is_ambiguous ? std::optional(Radians{axis_rad}) : std::nullopt;
}

}  // namespace

nav_state_t to_message(const messages::Navigation& navigation) {
  nav_state_t m{};
  m.utime = navigation.time.us;
  m.north_m = navigation.position.north.value;
  m.east_m = navigation.position.east.value;
  m.depth_m = navigation.depth.value;
  m.heading_rad = navigation.heading.value;
  m.speed_mps = navigation.speed.value;
  return m;
}

snr_estimate_t to_message(const messages::SnrMeasurement& measurement) {
  snr_estimate_t m{};
  m.utime = measurement.time.us;
  m.snr_db = measurement.snr.value;
  m.too_faint = measurement.too_faint ? 1 : 0;
  return m;
}

bearing_t to_message(const messages::BearingMeasurement& measurement) {
  const messages::Bearing& bearing = measurement.bearing;
  bearing_t m{};
  m.utime = measurement.time.us;
  m.bearing_rad = bearing.direction.value;
  m.deviation_rad = bearing.deviation.value;
  m.ambiguous = bearing.mirror_axis ? 1 : 0;
  m.axis_rad = bearing.mirror_axis.value_or(Radians{}).value;
  m.sender = static_cast<std::int32_t>(measurement.sender);
  return m;
}

detection_t to_message(const messages::SoundDetection& detection) {
  detection_t m{};
  m.utime = detection.begin.us;
  m.duration_us = detection.duration.us;
  m.level_db_re_1upa = detection.level.value;
  m.snr_db = detection.snr.value;
  m.clipped = detection.is_clipped ? 1 : 0;
  return m;
}

operator_command_t to_message(const messages::OperatorCommand& command) {
  operator_command_t m{};
  m.utime = command.time.us;
  m.expiry_utime = command.expiry.us;
  m.issuer = static_cast<std::int32_t>(command.issuer);
  m.number = static_cast<std::int32_t>(command.number);
  m.command = static_cast<std::int8_t>(command.order);
  m.max_depth_m = command.limits.max_depth.value_or(Meters{kNotSaid}).value;
  m.max_speed_mps = command.limits.max_speed.value_or(MetersPerSecond{kNotSaid}).value;
  m.max_time_s = command.limits.max_time_s.value_or(kNotSaid);
  std::copy(command.mark.begin(), command.mark.end(), std::begin(m.mark));
  m.verified = command.is_verified ? kVerified : (command.has_old_mark ? kOldMark : std::int8_t{0});
  return m;
}

command_acknowledgement_t to_message(const messages::CommandAcknowledgement& acknowledgement) {
  command_acknowledgement_t m{};
  m.utime = acknowledgement.time.us;
  m.issuer = static_cast<std::int32_t>(acknowledgement.issuer);
  m.number = static_cast<std::int32_t>(acknowledgement.number);
  m.command = static_cast<std::int8_t>(acknowledgement.order);
  m.outcome = static_cast<std::int8_t>(acknowledgement.outcome);
  return m;
}

vehicle_status_t to_message(const messages::VehicleStatus& status) {
  vehicle_status_t m{};
  m.utime = status.time.us;
  m.altitude_m = status.altitude.value;
  m.battery_percent = status.battery_percent;
  m.leak = status.has_leak ? 1 : 0;
  m.ground_fault = status.has_ground_fault ? 1 : 0;
  return m;
}

autopilot_status_t to_message(const messages::AutopilotStatus& status) {
  autopilot_status_t m{};
  m.utime = status.time.us;
  m.follows_setpoints = status.follows_setpoints ? 1 : 0;
  return m;
}

hydrophone_status_t to_message(const messages::HydrophoneStatus& status) {
  hydrophone_status_t m{};
  m.utime = status.time.us;
  m.deaf = status.is_deaf ? 1 : 0;
  return m;
}

safety_event_t to_message(const messages::SafetyEvent& event) {
  safety_event_t m{};
  m.utime = event.time.us;
  m.rule = static_cast<std::int8_t>(event.rule);
  m.condition = static_cast<std::int8_t>(event.condition);
  m.response = static_cast<std::int8_t>(event.response);
  m.begins = event.begins ? 1 : 0;
  m.measure = event.measure;
  m.limit = event.limit;
  return m;
}

challenge_t to_message(const messages::ToldChallenge& told) {
  challenge_t m{};
  m.utime = told.time.us;
  std::ranges::copy(told.challenge.nonce, std::begin(m.nonce));
  std::ranges::copy(told.challenge.vehicle, std::begin(m.vehicle));
  std::ranges::copy(told.challenge.mission, std::begin(m.mission));
  std::ranges::copy(told.mark, std::begin(m.mark));
  return m;
}

port_report_t to_message(const messages::PortReport& report) {
  port_report_t m{};
  m.port = static_cast<std::int8_t>(report.port);
  m.link_up = report.link_up ? 1 : 0;
  m.received = static_cast<std::int64_t>(report.received);
  m.lost = static_cast<std::int64_t>(report.lost);
  m.malformed = static_cast<std::int64_t>(report.malformed);
  m.unsent = static_cast<std::int64_t>(report.unsent);
  return m;
}

unsent_setpoints_t to_message(const messages::UnsentSetpoints& unsent) {
  unsent_setpoints_t m{};
  m.count = static_cast<std::int64_t>(unsent.count);
  return m;
}

setpoint_t to_message(const messages::Setpoint& setpoint, Time now) {
  setpoint_t m{};
  m.utime = now.us;
  m.heading_rad = setpoint.heading.value;
  m.speed_mps = setpoint.speed.value;
  m.depth_m = setpoint.depth.value;
  m.waypoint_north_m = setpoint.waypoint.north.value;
  m.waypoint_east_m = setpoint.waypoint.east.value;
  m.release_weight = setpoint.release_weight ? 1 : 0;
  return m;
}

decision_t to_message(const messages::Decision& decision) {
  decision_t m{};
  m.utime = decision.time.us;
  m.step = static_cast<std::int32_t>(decision.step);
  m.north_m = decision.position.north.value;
  m.east_m = decision.position.east.value;
  m.snr_db = decision.snr.value;
  m.too_faint = decision.too_faint ? 1 : 0;
  m.detected = decision.detected ? 1 : 0;
  m.has_bearing = decision.bearing ? 1 : 0;
  if (decision.bearing) {
    m.bearing_rad = decision.bearing->direction.value;
    m.bearing_deviation_rad = decision.bearing->deviation.value;
    m.bearing_ambiguous = decision.bearing->mirror_axis ? 1 : 0;
    m.bearing_axis_rad = decision.bearing->mirror_axis.value_or(Radians{}).value;
  }
  m.action = static_cast<std::int8_t>(decision.action);
  m.sweeping = decision.sweeping ? 1 : 0;
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
    m.surprise_bits = decision.belief->surprise_bits;
  }
  m.found = decision.found ? 1 : 0;
  if (decision.found) {
    m.found_probability = decision.found->probability;
    m.found_least_snr_db = decision.found->least_snr.value;
    m.closest_approach_m = decision.found->closest_approach.value;
  }
  return m;
}

health_t to_message(const messages::Health& health, Time now) {
  static_assert(std::size(health_t{}.ports) == config::kMaxPorts);
  health_t m{};
  m.utime = now.us;
  m.turn = static_cast<std::int64_t>(health.turn);
  m.decisions = static_cast<std::int32_t>(health.decisions);
  m.authority = static_cast<std::int8_t>(health.authority);
  m.paused = health.is_paused ? 1 : 0;
  m.state = static_cast<std::int8_t>(health.state);
  m.end_reason = static_cast<std::int8_t>(health.end_reason);
  m.steps_taken = static_cast<std::int32_t>(health.steps_taken);
  m.surprise_bits = health.surprise_bits;
  m.sweeping = health.is_sweeping ? 1 : 0;
  m.found = health.is_found ? 1 : 0;
  m.navigation_refused = static_cast<std::int64_t>(health.counters.navigation_refused);
  m.snr_refused = static_cast<std::int64_t>(health.counters.snr_refused);
  m.commands_refused = static_cast<std::int64_t>(health.counters.commands_refused);
  m.setpoints_limited = static_cast<std::int64_t>(health.counters.setpoints_limited);
  m.status_refused = static_cast<std::int64_t>(health.counters.status_refused);
  m.bearings_refused = static_cast<std::int64_t>(health.counters.bearings_refused);
  m.bearings_of_others = static_cast<std::int64_t>(health.counters.bearings_of_others);
  m.response = static_cast<std::int8_t>(health.response);
  m.port_count = static_cast<std::int8_t>(health.ports.size());
  for (std::size_t i = 0; i < health.ports.size(); ++i) m.ports[i] = to_message(health.ports[i]);
  return m;
}

mission_t to_message(const config::Mission& mission, Time now) {
  mission_t m{};
  m.utime = now.us;
  m.south_m = mission.operating_area.south_west.north.value;
  m.west_m = mission.operating_area.south_west.east.value;
  m.north_m = mission.operating_area.north_east.north.value;
  m.east_m = mission.operating_area.north_east.east.value;
  m.edge_margin_m = mission.edge_margin.value;
  m.search_depth_m = mission.search_depth.value;
  m.max_depth_m = mission.max_depth.value;
  m.search_speed_mps = mission.search_speed.value;
  m.step_length_m = mission.step_length.value;
  m.source_frequency_hz = mission.source_frequency.value;
  m.max_steps = static_cast<std::int32_t>(mission.max_steps);
  m.ends_when_found = mission.ends_when_found ? 1 : 0;
  m.max_time_us = mission.max_time.us;
  m.navigation_timeout_us = mission.navigation_timeout.us;
  m.snr_timeout_us = mission.snr_timeout.us;
  m.detection_threshold_db = mission.detection_threshold.value;
  m.needs_verified_commands = mission.authority.needs_verified_commands ? 1 : 0;
  m.autopilot_timeout_us = mission.authority.autopilot_timeout.us;
  m.listening = static_cast<std::int8_t>(mission.listening.listening);
  m.listening_window_us = mission.listening.length.us;
  m.action_seed = static_cast<std::int64_t>(mission.action_seed);
  put_safety(mission.safety, m);
  return m;
}

messages::Navigation from_message(const nav_state_t& m) {
  return {.time = {m.utime},
          .position = {Meters{m.north_m}, Meters{m.east_m}},
          .depth = Meters{m.depth_m},
          .heading = Radians{m.heading_rad},
          .speed = MetersPerSecond{m.speed_mps}};
}

messages::SnrMeasurement from_message(const snr_estimate_t& m) {
  return {.time = {m.utime}, .snr = Decibels{m.snr_db}, .too_faint = m.too_faint != 0};
}

messages::BearingMeasurement from_message(const bearing_t& m) {
  return {.time = {m.utime},
          .bearing = {.direction = Radians{m.bearing_rad},
                      .deviation = Radians{m.deviation_rad},
                      .mirror_axis = axis_if(m.ambiguous != 0, m.axis_rad)},
          .sender = static_cast<std::uint32_t>(m.sender)};
}

std::optional<messages::Bearing> bearing_in(const decision_t& m) {
  if (m.has_bearing == 0) return std::nullopt;
  return messages::Bearing{.direction = Radians{m.bearing_rad},
                           .deviation = Radians{m.bearing_deviation_rad},
                           .mirror_axis = axis_if(m.bearing_ambiguous != 0, m.bearing_axis_rad)};
}

messages::VehicleStatus from_message(const vehicle_status_t& m) {
  return {.time = {m.utime},
          .altitude = Meters{m.altitude_m},
          .battery_percent = m.battery_percent,
          .has_leak = m.leak != 0,
          .has_ground_fault = m.ground_fault != 0};
}

messages::AutopilotStatus from_message(const autopilot_status_t& m) {
  return {.time = {m.utime}, .follows_setpoints = m.follows_setpoints != 0};
}

messages::HydrophoneStatus from_message(const hydrophone_status_t& m) {
  return {.time = {m.utime}, .is_deaf = m.deaf != 0};
}

messages::SafetyEvent from_message(const safety_event_t& m) {
  return {.time = {m.utime},
          .rule = static_cast<std::uint8_t>(m.rule),
          .condition = static_cast<config::Condition>(m.condition),
          .response = static_cast<config::Response>(m.response),
          .begins = m.begins != 0,
          .measure = m.measure,
          .limit = m.limit};
}

messages::OperatorCommand from_message(const operator_command_t& m) {
  messages::OperatorCommand command{.time = {m.utime},
                                    .expiry = {m.expiry_utime},
                                    .issuer = static_cast<std::uint32_t>(m.issuer),
                                    .number = static_cast<std::uint32_t>(m.number),
                                    .order = static_cast<messages::Order>(m.command),
                                    .limits = {.max_depth = if_said<Meters>(m.max_depth_m),
                                               .max_speed = if_said<MetersPerSecond>(m.max_speed_mps),
                                               .max_time_s = if_said<double>(m.max_time_s)},
                                    .is_verified = m.verified == kVerified,
                                    .has_old_mark = m.verified == kOldMark};
  std::copy(std::begin(m.mark), std::end(m.mark), command.mark.begin());
  return command;
}

messages::ToldChallenge from_message(const challenge_t& m) {
  messages::ToldChallenge told{.time = {m.utime}, .challenge = {}};
  std::ranges::copy(m.nonce, told.challenge.nonce.begin());
  std::ranges::copy(m.vehicle, told.challenge.vehicle.begin());
  std::ranges::copy(m.mission, told.challenge.mission.begin());
  std::ranges::copy(m.mark, told.mark.begin());
  return told;
}

messages::Setpoint from_message(const setpoint_t& m) {
  return {.heading = Radians{m.heading_rad},
          .speed = MetersPerSecond{m.speed_mps},
          .depth = Meters{m.depth_m},
          .waypoint = {Meters{m.waypoint_north_m}, Meters{m.waypoint_east_m}},
          .release_weight = m.release_weight != 0};
}

messages::PortReport from_message(const port_report_t& m) {
  return {.port = static_cast<std::uint8_t>(m.port),
          .link_up = m.link_up != 0,
          .received = static_cast<std::uint64_t>(m.received),
          .lost = static_cast<std::uint64_t>(m.lost),
          .malformed = static_cast<std::uint64_t>(m.malformed),
          .unsent = static_cast<std::uint64_t>(m.unsent)};
}

messages::UnsentSetpoints from_message(const unsent_setpoints_t& m) {
  return {.count = static_cast<std::uint64_t>(m.count)};
}

config::Mission from_message(const mission_t& m) {
  return {.operating_area = {.south_west = {Meters{m.south_m}, Meters{m.west_m}}, .north_east = {Meters{m.north_m}, Meters{m.east_m}}},
          .edge_margin = Meters{m.edge_margin_m},
          .search_depth = Meters{m.search_depth_m},
          .max_depth = Meters{m.max_depth_m},
          .search_speed = MetersPerSecond{m.search_speed_mps},
          .step_length = Meters{m.step_length_m},
          .max_steps = static_cast<std::uint32_t>(m.max_steps),
          .ends_when_found = m.ends_when_found != 0,
          .max_time = {m.max_time_us},
          .navigation_timeout = {m.navigation_timeout_us},
          .snr_timeout = {m.snr_timeout_us},
          .detection_threshold = Decibels{m.detection_threshold_db},
          .source_frequency = Hertz{m.source_frequency_hz},
          .listening = {.listening = static_cast<config::Listening>(m.listening), .length = {m.listening_window_us}},
          .safety = safety_in(m),
          .authority = {.needs_verified_commands = m.needs_verified_commands != 0, .autopilot_timeout = {m.autopilot_timeout_us}},
          .action_seed = static_cast<std::uint64_t>(m.action_seed)};
}

}  // namespace earshot::wire
