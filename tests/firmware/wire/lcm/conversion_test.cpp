#include "firmware/wire/lcm/conversion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::wire {
namespace {

/// A message after its way over the bus.
template <class Message>
Message carried(const Message& sent) {
  Message arrived{};
  EXPECT_EQ(decode(Encoded(sent).bytes(), arrived), Status::kOk);
  return arrived;
}

TEST(Conversion, CarriesCountersBeyondThirtyTwoBits) {
  messages::Health health;
  health.counters = {.navigation_refused = std::uint64_t{1} << 31U,
                     .snr_refused = std::uint64_t{1} << 32U,
                     .commands_refused = std::uint64_t{1} << 40U,
                     .setpoints_limited = (std::uint64_t{1} << 63U) - 1,
                     .bearings_refused = std::uint64_t{1} << 33U,
                     .bearings_of_others = std::uint64_t{1} << 34U};
  const health_t arrived = carried(to_message(health, Time{7}));
  EXPECT_EQ(arrived.navigation_refused, 2'147'483'648);
  EXPECT_EQ(arrived.snr_refused, 4'294'967'296);
  EXPECT_EQ(arrived.commands_refused, 1'099'511'627'776);
  EXPECT_EQ(arrived.setpoints_limited, 9'223'372'036'854'775'807);
  EXPECT_EQ(arrived.bearings_refused, 8'589'934'592);
  EXPECT_EQ(arrived.bearings_of_others, 17'179'869'184);
}

TEST(Conversion, GivesAPortReportBackWhateverItCounted) {
  const messages::PortReport report{.port = 7,
                                    .link_up = false,
                                    .received = 4'294'967'296,
                                    .lost = 4'294'967'297,
                                    .malformed = 9'223'372'036'854'775'807,
                                    .unsent = 2'147'483'648};
  EXPECT_EQ(from_message(carried(to_message(report))), report);
  EXPECT_EQ(carried(to_message(report)).link_up, 0);
  messages::PortReport up = report;
  up.link_up = true;
  EXPECT_EQ(carried(to_message(up)).link_up, 1);
  EXPECT_EQ(from_message(carried(to_message(up))), up);
}

TEST(Conversion, TellsEveryFieldOfADetection) {
  const detection_t arrived = carried(to_message(messages::SoundDetection{
      .begin = Time{5}, .duration = Duration{6}, .level = Decibels{104.5}, .snr = Decibels{-2.5}, .is_clipped = true}));
  EXPECT_EQ(arrived.utime, 5);
  EXPECT_EQ(arrived.duration_us, 6);
  EXPECT_EQ(arrived.level_db_re_1upa, 104.5);
  EXPECT_EQ(arrived.snr_db, -2.5);
  EXPECT_EQ(arrived.clipped, 1);
  messages::SoundDetection whole;
  whole.is_clipped = false;
  EXPECT_EQ(carried(to_message(whole)).clipped, 0);
}

TEST(Conversion, GivesACommandBackWhateverItsNumber) {
  const messages::OperatorCommand command{
      .time = Time{5}, .expiry = Time{6}, .issuer = 4'294'967'295, .number = 2'147'483'648, .order = messages::Order::kStart};
  EXPECT_EQ(from_message(carried(to_message(command))), command);
}

TEST(Conversion, GivesATighteningBackWithItsLimitsAndItsMark) {
  messages::OperatorCommand command{.time = Time{5},
                                    .expiry = Time{6},
                                    .issuer = 1,
                                    .number = 2,
                                    .order = messages::Order::kTighten,
                                    .limits = {.max_depth = Meters{100.5}, .max_speed = MetersPerSecond{1.5}, .max_time_s = 60.25},
                                    .mark = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 255},
                                    .is_verified = true};
  EXPECT_EQ(from_message(carried(to_message(command))), command);
  command.limits = {};
  EXPECT_EQ(from_message(carried(to_message(command))), command);
}

TEST(Conversion, GivesAnOrderBackWithWhatItsMarkIsWorth) {
  messages::OperatorCommand command{.time = Time{5}, .expiry = Time{6}, .issuer = 1, .number = 2, .order = messages::Order::kStart};
  command.has_old_mark = true;
  EXPECT_EQ(from_message(carried(to_message(command))), command);
  operator_command_t strange = to_message(command);
  strange.verified = 3;
  EXPECT_FALSE(from_message(carried(strange)).is_verified);
  EXPECT_FALSE(from_message(carried(strange)).has_old_mark);
}

TEST(Conversion, GivesAChallengeBack) {
  messages::ToldChallenge told{.time = Time{5}, .challenge = {.nonce = {1, 2}, .vehicle = {3}, .mission = {4}}, .mark = {5}};
  told.challenge.nonce[15] = 6;
  told.challenge.vehicle[31] = 7;
  told.challenge.mission[31] = 8;
  told.mark[15] = 9;
  EXPECT_EQ(from_message(carried(to_message(told))), told);
}

TEST(Conversion, GivesAFixWhoseSpeedNobodyKnowsBackAsOne) {
  const messages::Navigation fix{.time = Time{5},
                                 .position = {Meters{1.0}, Meters{2.0}},
                                 .depth = Meters{3.0},
                                 .heading = Radians{0.5},
                                 .speed = messages::kUnknownSpeed};
  const messages::Navigation arrived = from_message(carried(to_message(fix)));
  EXPECT_TRUE(std::isnan(arrived.speed.value));
  EXPECT_TRUE(messages::is_usable(arrived));
  EXPECT_EQ(arrived.heading, fix.heading);
}

TEST(Conversion, GivesEveryFieldOfAFixAndOfALookBack) {
  const messages::Navigation fix{.time = Time{5},
                                 .position = {Meters{1.0}, Meters{2.0}},
                                 .depth = Meters{3.0},
                                 .heading = Radians{0.5},
                                 .speed = MetersPerSecond{1.5}};
  EXPECT_EQ(from_message(carried(to_message(fix))), fix);
  const nav_state_t m = carried(to_message(fix));
  EXPECT_EQ(m.utime, 5);
  EXPECT_EQ(m.north_m, 1.0);
  EXPECT_EQ(m.east_m, 2.0);
  EXPECT_EQ(m.depth_m, 3.0);
  EXPECT_EQ(m.heading_rad, 0.5);
  EXPECT_EQ(m.speed_mps, 1.5);
  for (const bool too_faint : {false, true}) {
    const messages::SnrMeasurement look{.time = Time{6}, .snr = Decibels{-7.5}, .too_faint = too_faint};
    EXPECT_EQ(from_message(carried(to_message(look))), look);
    EXPECT_EQ(carried(to_message(look)).too_faint, too_faint ? 1 : 0);
  }
}

TEST(Conversion, GivesABearingBackWithItsMirrorsAxisOrWithout) {
  for (const std::optional<Radians>& axis : {std::optional<Radians>(), std::optional(Radians{0.75})}) {
    const messages::BearingMeasurement measurement{
        .time = Time{6}, .bearing = {.direction = Radians{1.5}, .deviation = Radians{0.25}, .mirror_axis = axis}, .sender = 4'000'000'000};
    EXPECT_EQ(from_message(carried(to_message(measurement))), measurement);
    messages::Decision decision;
    decision.bearing = measurement.bearing;
    EXPECT_EQ(bearing_in(carried(to_message(decision))), measurement.bearing);
  }
  EXPECT_FALSE(bearing_in(carried(to_message(messages::Decision{}))));
}

TEST(Conversion, LeavesAnAxisThatIsSaidAloneToNobody) {
  bearing_t m{};
  m.axis_rad = 0.75;
  EXPECT_FALSE(from_message(m).bearing.mirror_axis);
}

TEST(Conversion, GivesASetpointBackAndSaysWhenItWasSent) {
  const messages::Setpoint setpoint{
      .heading = Radians{0.5}, .speed = MetersPerSecond{1.5}, .depth = Meters{300.0}, .waypoint = {Meters{1.0}, Meters{2.0}}};
  EXPECT_EQ(from_message(carried(to_message(setpoint, Time{7}))), setpoint);
  EXPECT_EQ(carried(to_message(setpoint, Time{7})).utime, 7);
}

TEST(Conversion, TellsEveryFieldOfAnAcknowledgement) {
  const command_acknowledgement_t arrived =
      carried(to_message(messages::CommandAcknowledgement{.time = Time{5},
                                                          .port = 3,
                                                          .issuer = 4'294'967'295,
                                                          .number = 2'147'483'648,
                                                          .order = messages::Order::kStart,
                                                          .outcome = messages::CommandOutcome::kExpired}));
  EXPECT_EQ(arrived.utime, 5);
  EXPECT_EQ(arrived.issuer, -1);  // the bus has no numbers without a sign: those of 32 bits come as they lie in memory
  EXPECT_EQ(arrived.number, std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(arrived.command, 1);
  EXPECT_EQ(arrived.outcome, 3);
}

messages::Decision decision_of_step_nine() {
  messages::Decision decision{.step = 9,
                              .time = Time{5},
                              .position = {Meters{1.0}, Meters{2.0}},
                              .snr = Decibels{-7.5},
                              .too_faint = true,
                              .action = 6,
                              .overridden = true,
                              .waypoint = {Meters{3.0}, Meters{4.0}},
                              .observation_size = 62,
                              .action_count = 8,
                              .belief = {}};
  for (std::size_t i = 0; i < decision.observation.size(); ++i) decision.observation[i] = 0.5F + static_cast<float>(i);
  for (std::size_t i = 0; i < decision.logits.size(); ++i) decision.logits[i] = -0.5F - static_cast<float>(i);
  return decision;
}

TEST(Conversion, TellsEveryFieldOfADecision) {
  const decision_t arrived = carried(to_message(decision_of_step_nine()));
  EXPECT_EQ(arrived.utime, 5);
  EXPECT_EQ(arrived.step, 9);
  EXPECT_EQ(arrived.north_m, 1.0);
  EXPECT_EQ(arrived.east_m, 2.0);
  EXPECT_EQ(arrived.snr_db, -7.5);
  EXPECT_EQ(arrived.too_faint, 1);
  EXPECT_EQ(arrived.detected, 0);
  EXPECT_EQ(arrived.action, 6);
  EXPECT_EQ(arrived.overridden, 1);
  EXPECT_EQ(arrived.waypoint_north_m, 3.0);
  EXPECT_EQ(arrived.waypoint_east_m, 4.0);
  EXPECT_EQ(arrived.observation_size, 62);
  EXPECT_EQ(arrived.action_count, 8);
  EXPECT_EQ(arrived.observation[0], 0.5F);
  EXPECT_EQ(arrived.observation[63], 63.5F);
  EXPECT_EQ(arrived.logits[0], -0.5F);
  EXPECT_EQ(arrived.logits[31], -31.5F);

  messages::Decision detected = decision_of_step_nine();
  detected.too_faint = detected.overridden = false;
  detected.detected = true;
  EXPECT_EQ(carried(to_message(detected)).detected, 1);
  EXPECT_EQ(carried(to_message(detected)).too_faint, 0);
  EXPECT_EQ(carried(to_message(detected)).overridden, 0);
}

TEST(Conversion, TellsTheBeliefOfADecisionThatHasOneAndZerosOfAnyOther) {
  messages::Decision decision = decision_of_step_nine();
  const decision_t without = carried(to_message(decision));
  EXPECT_EQ(without.believes, 0);
  for (const double number :
       {without.likeliest_north_m, without.likeliest_east_m, without.mean_north_m, without.mean_east_m, without.spread_m})
    EXPECT_EQ(number, 0.0);
  EXPECT_EQ(without.likeliest_share, 0.0F);
  EXPECT_EQ(without.effective_cells, 0.0F);

  decision.belief = {.likeliest = {Meters{500.0}, Meters{250.0}},
                     .mean = {Meters{600.0}, Meters{350.0}},
                     .spread = Meters{70.0},
                     .likeliest_share = 0.25F,
                     .effective_cells = 12.5F};
  const decision_t with = carried(to_message(decision));
  EXPECT_EQ(with.believes, 1);
  EXPECT_EQ(with.likeliest_north_m, 500.0);
  EXPECT_EQ(with.likeliest_east_m, 250.0);
  EXPECT_EQ(with.mean_north_m, 600.0);
  EXPECT_EQ(with.mean_east_m, 350.0);
  EXPECT_EQ(with.spread_m, 70.0);
  EXPECT_EQ(with.likeliest_share, 0.25F);
  EXPECT_EQ(with.effective_cells, 12.5F);
}

TEST(Conversion, TellsEveryFieldOfHealthAndOfEachPort) {
  messages::Health health;
  health.state = messages::MissionState::kAbort;
  health.end_reason = messages::EndReason::kTimeUsedUp;
  health.steps_taken = 37;
  health.turn = std::uint64_t{1} << 40U;
  health.decisions = 38;
  health.authority = messages::Authority::kAbort;
  health.is_paused = true;
  for (const std::uint8_t port : {std::uint8_t{2}, std::uint8_t{5}})
    EXPECT_EQ(health.ports.push_back({.port = port, .received = 100U + port}), Status::kOk);
  const health_t arrived = carried(to_message(health, Time{7}));
  EXPECT_EQ(arrived.utime, 7);
  EXPECT_EQ(arrived.state, 3);
  EXPECT_EQ(arrived.end_reason, 7);
  EXPECT_EQ(arrived.steps_taken, 37);
  EXPECT_EQ(arrived.turn, std::int64_t{1} << 40U);
  EXPECT_EQ(arrived.decisions, 38);
  EXPECT_EQ(arrived.authority, 4);
  EXPECT_EQ(arrived.paused, 1);
  EXPECT_EQ(arrived.port_count, 2);
  EXPECT_EQ(arrived.ports[0].port, 2);
  EXPECT_EQ(arrived.ports[1].port, 5);
  EXPECT_EQ(arrived.ports[1].received, 105);
  EXPECT_EQ(arrived.ports[2].received, 0);
}

config::Polygon polygon_of(std::size_t corners, double first) {
  config::Polygon polygon;
  for (std::size_t i = 0; i < corners; ++i) {
    const double north = first + static_cast<double>(i);
    EXPECT_EQ(polygon.push_back({.north = Meters{north}, .east = Meters{-north}}), Status::kOk);
  }
  return polygon;
}

/// As much of everything as there is room for, and no two numbers the same.
config::Safety some_safety() {
  config::Safety safety;
  safety.fence =
      config::Fence{.inside = polygon_of(3, 100), .save = polygon_of(config::kMaxPolygonCorners, 200), .halt = polygon_of(4, 300)};
  for (std::size_t i = 0; i < config::kMaxNoSurfaceZones; ++i)
    EXPECT_EQ(safety.no_surface.push_back(polygon_of(3 + i, 400 + 100 * static_cast<double>(i))), Status::kOk);
  safety.safe_point = {.north = Meters{20.0}, .east = Meters{21.0}};
  safety.vehicle = {.max_speed = MetersPerSecond{22.0},
                    .max_current = MetersPerSecond{23.0},
                    .turn_radius = Meters{24.0},
                    .hold_speed = MetersPerSecond{25.0},
                    .ascent_speed = MetersPerSecond{26.0},
                    .ascent_rate = MetersPerSecond{28.0},
                    .surface_depth = Meters{29.0},
                    .battery_percent_per_km = 27.0};
  for (std::size_t i = 0; i < config::kMaxOwnRules; ++i) {
    const config::Rule rule{.condition = static_cast<config::Condition>(config::kConditions - 1 - i % config::kConditions),
                            .limit = 0.5 + static_cast<double>(i),
                            .persistence = Duration::milliseconds(static_cast<std::int64_t>(i) + 1),
                            .response = static_cast<config::Response>(i % config::kResponses),
                            .is_latched = i % 2 == 0};
    EXPECT_EQ(safety.rules.push_back(rule), Status::kOk);
  }
  return safety;
}

TEST(Conversion, GivesEveryFieldOfAMissionBack) {
  const config::Mission mission{
      .operating_area = {.south_west = {Meters{1.0}, Meters{2.0}}, .north_east = {Meters{3.0}, Meters{4.0}}},
      .edge_margin = Meters{5.0},
      .search_depth = Meters{6.0},
      .max_depth = Meters{7.0},
      .search_speed = MetersPerSecond{8.0},
      .step_length = Meters{9.0},
      .max_steps = 10,
      .ends_when_found = true,
      .max_time = Duration::seconds(11),
      .navigation_timeout = Duration::seconds(12),
      .snr_timeout = Duration::seconds(13),
      .detection_threshold = Decibels{14.0},
      .source_frequency = Hertz{18.0},
      .listening = {.listening = config::Listening::kMean, .length = Duration::seconds(15)},
      .safety = some_safety(),
      .authority = {.needs_verified_commands = true, .autopilot_timeout = Duration::seconds(17)},
      .action_seed = (std::uint64_t{1} << 63U) + 16,
  };
  // A field more does not compile here: give it a value above that is not its default.
  const auto& [area, margin, depth, max_depth, speed, step, steps, ends_when_found, time, navigation, snr, threshold, frequency, listening,
               safety, authority, seed] = mission;
  EXPECT_TRUE(ends_when_found);
  EXPECT_EQ(frequency, Hertz{18.0});
  EXPECT_EQ(seed, (std::uint64_t{1} << 63U) + 16);
  EXPECT_EQ(safety.rules.size(), config::kMaxOwnRules);
  EXPECT_TRUE(authority.needs_verified_commands);
  EXPECT_EQ(from_message(carried(to_message(mission, Time{7}))), mission);
  EXPECT_EQ(Encoded(to_message(mission, Time{7})).bytes().size(), 2587U);
}

TEST(Conversion, GivesAMissionWithoutFenceOrRulesBack) {
  const config::Mission mission{};
  EXPECT_EQ(from_message(carried(to_message(mission, Time{7}))), mission);
}

TEST(Conversion, CutsCountsOfAMissionToWhatThereIsRoomFor) {
  config::Mission full;
  full.safety = some_safety();
  mission_t message = to_message(full, Time{7});
  message.rules = 100;
  message.corners[0] = 100;
  const config::Mission mission = from_message(carried(message));
  EXPECT_EQ(mission.safety.rules.size(), config::kMaxOwnRules);
  EXPECT_EQ(mission.safety.fence->inside.size(), config::kMaxPolygonCorners);
  message.rules = -1;
  EXPECT_TRUE(from_message(carried(message)).safety.rules.empty());
}

TEST(Conversion, GivesWhatVehicleAutopilotAndHydrophoneSayBack) {
  const messages::VehicleStatus vehicle{
      .time = Time{1}, .altitude = Meters{2.5}, .battery_percent = 3.5, .has_leak = true, .has_ground_fault = false};
  EXPECT_EQ(from_message(carried(to_message(vehicle))), vehicle);
  const messages::VehicleStatus other{
      .time = Time{1}, .altitude = Meters{4}, .battery_percent = 5, .has_leak = false, .has_ground_fault = true};
  EXPECT_EQ(from_message(carried(to_message(other))), other);
  for (const bool yes : {false, true}) {
    const messages::AutopilotStatus autopilot{.time = Time{6}, .follows_setpoints = yes};
    EXPECT_EQ(from_message(carried(to_message(autopilot))), autopilot);
    const messages::HydrophoneStatus hydrophone{.time = Time{7}, .is_deaf = yes};
    EXPECT_EQ(from_message(carried(to_message(hydrophone))), hydrophone);
  }
}

TEST(Conversion, GivesASafetyEventBack) {
  const messages::SafetyEvent event{.time = Time{1},
                                    .rule = 2,
                                    .condition = config::Condition::kBattery,
                                    .response = config::Response::kReturn,
                                    .begins = false,
                                    .measure = 3.5,
                                    .limit = 4.5};
  EXPECT_EQ(from_message(carried(to_message(event))), event);
}

}  // namespace
}  // namespace earshot::wire
