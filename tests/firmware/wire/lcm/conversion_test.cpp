#include "firmware/wire/lcm/conversion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

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
                     .setpoints_limited = (std::uint64_t{1} << 63U) - 1};
  const health_t arrived = carried(to_message(health, Time{7}));
  EXPECT_EQ(arrived.navigation_refused, 2'147'483'648);
  EXPECT_EQ(arrived.snr_refused, 4'294'967'296);
  EXPECT_EQ(arrived.commands_refused, 1'099'511'627'776);
  EXPECT_EQ(arrived.setpoints_limited, 9'223'372'036'854'775'807);
}

TEST(Conversion, GivesAPortReportBackWhateverItCounted) {
  const messages::PortReport report{.port = 7,
                                    .link_up = false,
                                    .received = 4'294'967'296,
                                    .lost = 4'294'967'297,
                                    .malformed = 9'223'372'036'854'775'807,
                                    .unsent = 2'147'483'648};
  EXPECT_EQ(from_message(carried(to_message(report))), report);
}

TEST(Conversion, TellsEveryFieldOfADetection) {
  const detection_t arrived = carried(to_message(messages::SoundDetection{
      .begin = Time{5}, .duration = Duration{6}, .level = Decibels{104.5}, .snr = Decibels{-2.5}, .is_clipped = true}));
  EXPECT_EQ(arrived.utime, 5);
  EXPECT_EQ(arrived.duration_us, 6);
  EXPECT_EQ(arrived.level_db_re_1upa, 104.5);
  EXPECT_EQ(arrived.snr_db, -2.5);
  EXPECT_EQ(arrived.clipped, 1);
}

TEST(Conversion, GivesACommandBackWhateverItsNumber) {
  const messages::OperatorCommand command{
      .time = Time{5}, .expiry = Time{6}, .issuer = 4'294'967'295, .number = 2'147'483'648, .order = messages::Order::kStart};
  EXPECT_EQ(from_message(carried(to_message(command))), command);
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

TEST(Conversion, GivesEveryFieldOfAMissionBack) {
  const config::Mission mission{
      .operating_area = {.south_west = {Meters{1.0}, Meters{2.0}}, .north_east = {Meters{3.0}, Meters{4.0}}},
      .edge_margin = Meters{5.0},
      .search_depth = Meters{6.0},
      .max_depth = Meters{7.0},
      .search_speed = MetersPerSecond{8.0},
      .step_length = Meters{9.0},
      .max_steps = 10,
      .max_time = Duration::seconds(11),
      .navigation_timeout = Duration::seconds(12),
      .snr_timeout = Duration::seconds(13),
      .detection_threshold = Decibels{14.0},
      .listening = {.listening = config::Listening::kMean, .length = Duration::seconds(15)},
      .action_seed = (std::uint64_t{1} << 63U) + 16,
  };
  // A field more does not compile here: give it a value above that is not its default.
  const auto& [area, margin, depth, max_depth, speed, step, steps, time, navigation, snr, threshold, listening, seed] = mission;
  EXPECT_EQ(seed, (std::uint64_t{1} << 63U) + 16);
  EXPECT_EQ(from_message(carried(to_message(mission, Time{7}))), mission);
}

}  // namespace
}  // namespace earshot::wire
