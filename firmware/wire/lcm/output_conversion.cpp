#include "firmware/wire/lcm/output_conversion.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>

#include "firmware/wire/lcm/conversion.hpp"

namespace earshot::wire {
namespace {

template <class To, class From>
void copy_all(const From& from, To& to) {
  const std::size_t count = std::min(std::size(from), std::size(to));
  std::copy_n(std::begin(from), count, std::begin(to));
}

template <class Count>
std::uint64_t counted(Count count) {
  return static_cast<std::uint64_t>(count);
}

messages::BeliefSummary belief_in(const decision_t& m) {
  return {.likeliest = {Meters{m.likeliest_north_m}, Meters{m.likeliest_east_m}},
          .mean = {Meters{m.mean_north_m}, Meters{m.mean_east_m}},
          .spread = Meters{m.spread_m},
          .likeliest_share = m.likeliest_share,
          .effective_cells = m.effective_cells,
          .surprise_bits = m.surprise_bits};
}

messages::FoundDeclaration found_in(const decision_t& m) {
  return {.probability = m.found_probability,
          .snr = Decibels{m.snr_db},
          .least_snr = Decibels{m.found_least_snr_db},
          .likeliest = {Meters{m.likeliest_north_m}, Meters{m.likeliest_east_m}},
          .closest_approach = Meters{m.closest_approach_m},
          .look = static_cast<std::uint32_t>(m.step)};
}

}  // namespace

messages::Decision from_message(const decision_t& m) {
  messages::Decision decision{.step = static_cast<std::uint32_t>(m.step),
                              .time = {m.utime},
                              .position = {Meters{m.north_m}, Meters{m.east_m}},
                              .snr = Decibels{m.snr_db},
                              .too_faint = m.too_faint != 0,
                              .detected = m.detected != 0,
                              .action = static_cast<std::uint8_t>(m.action),
                              .sweeping = m.sweeping != 0,
                              .overridden = m.overridden != 0,
                              .waypoint = {Meters{m.waypoint_north_m}, Meters{m.waypoint_east_m}},
                              .observation_size = static_cast<std::uint8_t>(m.observation_size),
                              .action_count = static_cast<std::uint8_t>(m.action_count),
                              .bearing = bearing_in(m),
                              .belief = m.believes != 0 ? std::optional(belief_in(m)) : std::nullopt,
                              .found = m.found != 0 ? std::optional(found_in(m)) : std::nullopt};
  copy_all(m.observation, decision.observation);
  copy_all(m.logits, decision.logits);
  return decision;
}

messages::Health from_message(const health_t& m) {
  messages::Health health{.turn = counted(m.turn),
                          .decisions = static_cast<std::uint32_t>(m.decisions),
                          .authority = static_cast<messages::Authority>(m.authority),
                          .is_paused = m.paused != 0,
                          .state = static_cast<messages::MissionState>(m.state),
                          .end_reason = static_cast<messages::EndReason>(m.end_reason),
                          .steps_taken = static_cast<std::uint32_t>(m.steps_taken),
                          .surprise_bits = m.surprise_bits,
                          .is_sweeping = m.sweeping != 0,
                          .is_found = m.found != 0,
                          .response = static_cast<config::Response>(m.response),
                          .counters = {.navigation_refused = counted(m.navigation_refused),
                                       .snr_refused = counted(m.snr_refused),
                                       .status_refused = counted(m.status_refused),
                                       .commands_refused = counted(m.commands_refused),
                                       .setpoints_limited = counted(m.setpoints_limited),
                                       .bearings_refused = counted(m.bearings_refused),
                                       .bearings_of_others = counted(m.bearings_of_others)},
                          .ports = {}};
  const int ports = std::clamp(static_cast<int>(m.port_count), 0, static_cast<int>(config::kMaxPorts));
  for (int i = 0; i < ports; ++i) static_cast<void>(health.ports.push_back(from_message(m.ports[i])));  // there is room
  return health;
}

messages::CommandAcknowledgement from_message(const command_acknowledgement_t& m, std::uint8_t port) {
  return {.time = {m.utime},
          .port = port,
          .issuer = static_cast<std::uint32_t>(m.issuer),
          .number = static_cast<std::uint32_t>(m.number),
          .order = static_cast<messages::Order>(m.command),
          .outcome = static_cast<messages::CommandOutcome>(m.outcome)};
}

}  // namespace earshot::wire
