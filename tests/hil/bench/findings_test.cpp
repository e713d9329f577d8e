// What is read from a journal.

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "hil/bench/verdict.hpp"
#include "tests/firmware/boards/linux/replay/random_mission.hpp"
#include "tests/hil/bench/judged_mission.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::hil {
namespace {

class FindingsTest : public testing::Test {
 protected:
  template <class Message>
  void record(std::int64_t s, std::string_view channel, const Message& message) {
    ASSERT_EQ(journal_->append(at_s(s), channel, wire::Encoded(message, at_s(s)).bytes()), Status::kOk);
  }
  void record_setpoint(std::int64_t s, double heading_rad, double speed_mps, double depth_m) {
    const messages::Setpoint setpoint{
        .heading = Radians{heading_rad}, .speed = MetersPerSecond{speed_mps}, .depth = Meters{depth_m}, .waypoint = {}};
    record(s, wire::kJournalledSetpointChannel, setpoint);
  }
  [[nodiscard]] JournalFindings read() {
    journal_.reset();
    return read_findings(path_, mission());
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "journal.lcmlog";
  std::unique_ptr<host::Journal> journal_ = std::make_unique<host::Journal>(path_);
};

TEST_F(FindingsTest, AreTheLastHealthAndEveryEventInItsOrder) {
  messages::Health health;
  health.counters.navigation_refused = 3;
  record(1, wire::kHealthChannel, health);
  const messages::SafetyEvent first = event(2, config::Condition::kLeak);
  const messages::SafetyEvent second = event(3, config::Condition::kLeak, false);
  record(2, wire::kSafetyEventChannel, first);
  record(3, wire::kSafetyEventChannel, second);
  health.end_reason = messages::EndReason::kSafetyRule;
  health.counters.navigation_refused = 4;
  for (const std::uint8_t port : {std::uint8_t{1}, std::uint8_t{2}})
    (void)health.ports.push_back({.port = port, .lost = port + std::uint64_t{1}});
  health.counters.commands_refused = 5;
  record(4, wire::kHealthChannel, health);
  const JournalFindings found = read();
  EXPECT_EQ(found.events, (std::vector<messages::SafetyEvent>{first, second}));
  EXPECT_EQ(found.end, messages::EndReason::kSafetyRule);
  EXPECT_EQ(found.counters.navigation_refused, 4U);
  EXPECT_EQ(found.lost.at(1), 2U);
  EXPECT_EQ(found.lost.at(2), 3U);
  EXPECT_EQ(found.counters.commands_refused, 5U);
  EXPECT_FALSE(found.is_same_again) << "there is no mission in it";
}

TEST_F(FindingsTest, AreDatedFromWhenTheFlightBegan) {
  record(102, wire::kSafetyEventChannel, event(102, config::Condition::kLeak));
  journal_.reset();
  const JournalFindings found = read_findings(path_, mission(), at_s(100));
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].time, at_s(2));
}

TEST_F(FindingsTest, NameSetPointsThatNoMissionMayGive) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  record_setpoint(1, 0.5, 2.0, 300.0);
  record_setpoint(2, 0.5, 0.0, 0.0);
  record_setpoint(3, 0.5, 2.0, 320.0);
  EXPECT_EQ(read().beyond_limits, Words{});
  journal_ = std::make_unique<host::Journal>(folder_ / "journal.lcmlog", host::JournalOptions{.existing = host::ExistingJournal::kReplace});
  record_setpoint(1, 0.5, 2.01, 300.0);
  record_setpoint(2, 0.5, -0.01, 300.0);
  record_setpoint(3, 0.5, 2.0, 320.5);
  record_setpoint(4, 0.5, 2.0, -0.01);
  record_setpoint(5, kNan, 2.0, 300.0);
  record_setpoint(6, 0.5, 2.0, 400.0);
  const JournalFindings found = read();
  EXPECT_EQ(found.setpoints, 6U);
  ASSERT_EQ(found.beyond_limits.size(), 5U) << "no more than that are named";
  EXPECT_TRUE(support::tells(found.beyond_limits[0], {"beyond", "1 s", "300 m", "2.01 m/s"}));
  EXPECT_TRUE(support::tells(found.beyond_limits[2], {"beyond", "3 s", "320.5 m", "2 m/s"}));
}

TEST_F(FindingsTest, LetAVehicleComeUpAsFastAsItMust) {
  record_setpoint(1, 0.5, 2.5, 0.0);
  journal_.reset();
  config::Mission fast = mission();
  EXPECT_EQ(read_findings(path_, fast).beyond_limits.size(), 1U);
  fast.safety.vehicle.ascent_speed = MetersPerSecond{2.5};
  EXPECT_EQ(read_findings(path_, fast).beyond_limits, Words{});
}

TEST_F(FindingsTest, SayWhatIsWrongWithAFileThatIsNoJournal) {
  journal_.reset();
  const JournalFindings found = read_findings(folder_ / "none.lcmlog", mission());
  EXPECT_NE(found.trouble.find("none.lcmlog"), std::string::npos) << found.trouble;
}

TEST_F(FindingsTest, SayWhetherTheJournalGivesEveryOutputAgainAndWhichItDoesNot) {
  journal_.reset();
  board::fly_random_mission(1, path_, 30);
  EXPECT_TRUE(read_findings(path_, mission()).is_same_again);
  const std::filesystem::path forged = folder_ / "forged.lcmlog";
  journal_ = std::make_unique<host::Journal>(forged);
  host::JournalReader reader(path_);
  std::uint32_t number = 0;
  for (host::JournalRecord record; reader.next(record);) {
    // A bit behind fingerprint and date of the first health.
    if (record.channel == wire::kHealthChannel && number == 0) {
      record.data[16] ^= 1U;
      number = record.number;
    }
    ASSERT_EQ(journal_->append(record.time, record.channel, record.data), Status::kOk);
  }
  journal_.reset();
  const JournalFindings found = read_findings(forged, mission());
  EXPECT_FALSE(found.is_same_again);
  EXPECT_EQ(found.trouble, "");
  EXPECT_EQ(found.difference, "record " + std::to_string(number) + " (EARSHOT_HEALTH)");
}

}  // namespace
}  // namespace earshot::hil
