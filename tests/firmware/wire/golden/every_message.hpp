#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "firmware/config/mission.hpp"
#include "firmware/messages/autopilot_status.hpp"
#include "firmware/messages/bearing_measurement.hpp"
#include "firmware/messages/challenge.hpp"
#include "firmware/messages/decision.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/hydrophone_status.hpp"
#include "firmware/messages/journal_records.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/messages/port_report.hpp"
#include "firmware/messages/safety_event.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/messages/snr_measurement.hpp"
#include "firmware/messages/sound_detection.hpp"
#include "firmware/messages/unsent_setpoints.hpp"
#include "firmware/messages/vehicle_status.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::wire {

// Every message, with as much as it can say; of flags and of what may be missing both. No two fields of one message hold the same number.

/// 2026-11-22 15:04:00.000001 UTC
inline constexpr Time kSampleTime{1'795'359'840'000'001};

inline messages::Decision sample_decision(bool has_all_fields) {
  messages::Decision decision;
  decision.step = 9;
  decision.time = kSampleTime;
  decision.position = at(1.5, -2.5);
  decision.snr = Decibels{-7.25};
  decision.too_faint = !has_all_fields;
  decision.detected = has_all_fields;
  decision.action = 6;
  decision.sweeping = has_all_fields;
  decision.overridden = !has_all_fields;
  decision.waypoint = at(3.5, 4.5);
  decision.observation_size = 62;
  decision.action_count = 8;
  for (std::size_t i = 0; i < decision.observation.size(); ++i) decision.observation[i] = 0.5F + static_cast<float>(i);
  for (std::size_t i = 0; i < decision.logits.size(); ++i) decision.logits[i] = -0.5F - static_cast<float>(i);
  if (!has_all_fields) return decision;
  decision.bearing = messages::Bearing{.direction = Radians{1.25}, .deviation = Radians{0.125}, .mirror_axis = Radians{0.75}};
  decision.belief = messages::BeliefSummary{.likeliest = at(500.5, 250.5),
                                            .mean = at(600.5, 350.5),
                                            .spread = Meters{70.5},
                                            .likeliest_share = 0.25F,
                                            .effective_cells = 12.5F,
                                            .mismatch_bits = 6.875F};
  decision.found = messages::FoundDeclaration{.probability = 0.96875F,
                                              .snr = Decibels{-7.25},
                                              .least_snr = Decibels{14.5},
                                              .likeliest = at(500.5, 250.5),
                                              .closest_approach = Meters{640.5},
                                              .measurement = 9,
                                              .near_measurements = 3};
  return decision;
}

inline messages::Health sample_health(bool has_all_fields) {
  messages::Health health;
  health.turn = 0x0000'5655'5453'5251;
  health.decisions = 38;
  health.authority = has_all_fields ? messages::Authority::kAbort : messages::Authority::kListen;
  health.is_paused = has_all_fields;
  health.state = has_all_fields ? messages::MissionState::kAbort : messages::MissionState::kSearch;
  health.end_reason = has_all_fields ? messages::EndReason::kFound : messages::EndReason::kNone;
  health.steps_taken = 37;
  health.mismatch_bits = 13.5F;
  health.is_sweeping = has_all_fields;
  health.is_found = has_all_fields;
  health.response = has_all_fields ? config::Response::kRelease : config::Response::kWarn;
  health.counters = {.navigation_refused = 101,
                     .snr_refused = 102,
                     .status_refused = 103,
                     .commands_refused = 104,
                     .setpoints_limited = 105,
                     .bearings_refused = 106,
                     .bearings_of_others = 107};
  for (std::uint8_t port = 0; has_all_fields && port < config::kMaxPorts; ++port)
    static_cast<void>(health.ports.push_back({.port = port,
                                              .link_up = port % 2 == 0,
                                              .received = 1000U + port,
                                              .lost = 2000U + port,
                                              .malformed = 3000U + port,
                                              .unsent = 4000U + port}));
  return health;
}

inline config::Polygon sample_polygon(std::size_t corners, double first) {
  config::Polygon polygon;
  for (std::size_t i = 0; i < corners; ++i)
    static_cast<void>(polygon.push_back(at(first + static_cast<double>(i), -first - static_cast<double>(i))));
  return polygon;
}

/// @param has_all_fields  with as many zones, corners and rules as there is room for
inline config::Mission sample_mission(bool has_all_fields) {
  config::Mission mission{.operating_area = {.south_west = at(1, 2), .north_east = at(3, 4)},
                          .edge_margin = Meters{5},
                          .search_depth = Meters{6},
                          .max_depth = Meters{7},
                          .search_speed = MetersPerSecond{8},
                          .step_length = Meters{9},
                          .max_steps = 10,
                          .ends_when_found = has_all_fields,
                          .max_time = Duration::seconds(11),
                          .navigation_timeout = Duration::seconds(12),
                          .snr_timeout = Duration::seconds(13),
                          .detection_threshold = Decibels{14},
                          .source_frequency = Hertz{15},
                          .listening = {.listening = config::Listening::kMean, .length = Duration::seconds(16)},
                          .safety = {},
                          .authority = {.needs_verified_commands = has_all_fields, .autopilot_timeout = Duration::seconds(17)},
                          .action_seed = (std::uint64_t{1} << 63U) + 18};
  if (!has_all_fields) return mission;
  config::Safety& safety = mission.safety;
  safety.fence = config::Fence{
      .inside = sample_polygon(3, 100), .save = sample_polygon(config::kMaxPolygonCorners, 200), .halt = sample_polygon(4, 300)};
  for (std::size_t i = 0; i < config::kMaxNoSurfaceZones; ++i)
    static_cast<void>(safety.no_surface.push_back(sample_polygon(3 + i, 400 + 100 * static_cast<double>(i))));
  safety.safe_point = at(20, 21);
  safety.vehicle = {.max_speed = MetersPerSecond{22},
                    .max_current = MetersPerSecond{23},
                    .turn_radius = Meters{24},
                    .hold_speed = MetersPerSecond{25},
                    .ascent_speed = MetersPerSecond{26},
                    .ascent_rate = MetersPerSecond{27},
                    .surface_depth = Meters{28},
                    .battery_percent_per_km = 29};
  for (std::size_t i = 0; i < config::kMaxOwnRules; ++i)
    static_cast<void>(safety.rules.push_back({.condition = static_cast<config::Condition>(24 - i),
                                              .limit = 0.5 + static_cast<double>(i),
                                              .persistence = Duration::milliseconds(static_cast<std::int64_t>(i) + 1),
                                              .response = static_cast<config::Response>(i % 7),
                                              .is_latched = i % 2 == 0}));
  return mission;
}

inline messages::OperatorCommand sample_order() {
  return {.time = kSampleTime,
          .expiry = kSampleTime + Duration::seconds(60),
          .issuer = 4'000'000'001,
          .number = 3'000'000'002,
          .order = messages::Order::kStart};
}

inline messages::OperatorCommand sample_tightening() {
  messages::OperatorCommand command = sample_order();
  command.order = messages::Order::kTighten;
  command.limits = {.max_depth = Meters{100.5}, .max_speed = MetersPerSecond{1.5}, .max_time_s = 600.0};
  command.mark = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 255};
  command.is_verified = true;
  return command;
}

inline messages::PublishedChallenge sample_challenge() {
  messages::PublishedChallenge told;
  told.time = kSampleTime;
  for (std::size_t i = 0; i < told.challenge.nonce.size(); ++i) told.challenge.nonce[i] = static_cast<std::uint8_t>(1 + i);
  for (std::size_t i = 0; i < told.challenge.vehicle.size(); ++i) told.challenge.vehicle[i] = static_cast<std::uint8_t>(0x41 + i);
  for (std::size_t i = 0; i < told.challenge.mission.size(); ++i) told.challenge.mission[i] = static_cast<std::uint8_t>(0x81 + i);
  for (std::size_t i = 0; i < told.mark.size(); ++i) told.mark[i] = static_cast<std::uint8_t>(0xC1 + i);
  return told;
}

inline constexpr messages::Setpoint kSampleSetpoint{.heading = Radians{0.5},
                                                    .speed = MetersPerSecond{1.5},
                                                    .depth = Meters{300.25},
                                                    .waypoint = {Meters{1000.5}, Meters{-2000.5}},
                                                    .release_weight = true};

inline constexpr messages::PortReport kSampleReport{
    .port = 7, .link_up = true, .received = 4'294'967'296, .lost = 21, .malformed = 22, .unsent = 23};

inline constexpr messages::CommandAcknowledgement kSampleAcknowledgement{.time = kSampleTime,
                                                                         .port = 3,
                                                                         .issuer = 4'000'000'001,
                                                                         .number = 3'000'000'002,
                                                                         .order = messages::Order::kStart,
                                                                         .outcome = messages::CommandOutcome::kObeyedNotDurable};

/// Calls `take(name, message)` for what goes into a runtime: all kinds of messages::Input.
template <class Take>
void for_each_sample_input(Take&& take) {
  using namespace messages;
  const Navigation fix{
      .time = kSampleTime, .position = at(1.5, -2.5), .depth = Meters{3.25}, .heading = Radians{0.5}, .speed = MetersPerSecond{1.75}};
  take("navigation", fix);
  Navigation without_speed = fix;
  without_speed.speed = kUnknownSpeed;
  take("navigation.without_speed", without_speed);
  take("snr", SnrMeasurement{.time = kSampleTime, .snr = Decibels{-7.25}});
  take("snr.too_faint", SnrMeasurement{.time = kSampleTime, .snr = Decibels{2.5}, .too_faint = true});
  BearingMeasurement bearing{
      .time = kSampleTime, .bearing = {.direction = Radians{1.25}, .deviation = Radians{0.125}}, .sender = 4'000'000'003};
  take("bearing", bearing);
  bearing.bearing.mirror_axis = Radians{0.75};
  take("bearing.ambiguous", bearing);
  take("order", sample_order());
  take("order.tighten", sample_tightening());
  OperatorCommand recorded = sample_order();
  recorded.has_old_mark = true;
  take("order.old_mark", recorded);
  take("port_report", kSampleReport);
  take("port_report.down", PortReport{.port = 1, .link_up = false});
  take("unsent_setpoints", UnsentSetpoints{.count = 4'294'967'301});
  take("vehicle_status", VehicleStatus{.time = kSampleTime, .altitude = Meters{20.5}, .battery_percent = 80.25, .has_leak = true});
  take("vehicle_status.unknown", VehicleStatus{.time = kSampleTime, .has_ground_fault = true});
  for (const bool yes : {false, true}) {
    take(yes ? "autopilot_status.follows" : "autopilot_status", AutopilotStatus{.time = kSampleTime, .follows_setpoints = yes});
    take(yes ? "hydrophone_status.deaf" : "hydrophone_status", HydrophoneStatus{.time = kSampleTime, .is_deaf = yes});
  }
}

/// Likewise for what comes out of it, and for what passes beside it, but for what has its time from elsewhere (set-points, health and
/// missions).
template <class Take>
void for_each_sample_output(Take&& take) {
  using namespace messages;
  take("decision", sample_decision(false));
  take("decision.all", sample_decision(true));
  take("acknowledgement", kSampleAcknowledgement);
  take("safety_event", SafetyEvent{.time = kSampleTime,
                                   .rule = 24,
                                   .condition = config::Condition::kSetpointsUnsent,
                                   .response = config::Response::kRelease,
                                   .begins = true,
                                   .measure = 14.5,
                                   .limit = 15.5});
  take("safety_event.over", SafetyEvent{.time = kSampleTime, .rule = 3, .begins = false, .measure = 1.0, .limit = 0.0});
  take("challenge", sample_challenge());
  take("detection",
       SoundDetection{
           .begin = kSampleTime, .duration = Duration{1'500'000}, .level = Decibels{104.5}, .snr = Decibels{12.5}, .is_clipped = true});
}

inline messages::ClosingRecord sample_closing() {
  return {.time = kSampleTime,
          .ending = messages::Ending::kClockLost,
          .state = messages::MissionState::kDone,
          .end_reason = messages::EndReason::kFound,
          .steps_taken = 37,
          .lost = {.streams = 41, .steering = 42, .orders = 43}};
}

}  // namespace earshot::wire
