#include "policy/report/sea/sea_flight.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "firmware/host/journal/words/wording.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "tests/policy/report/sea/sea_journal.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

using messages::CommandOutcome;
using messages::EndReason;
using messages::MissionState;
using messages::Order;

class SeaFlightTest : public testing::Test {
 protected:
  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "journal";
};

TEST_F(SeaFlightTest, CountsItsTimesFromTheFirstRecordAndKnowsItsDate) {
  SeaJournal journal(path_);
  journal.fix(60.5, 3'000, 4'000);
  journal.snr(61.0, -3.5, true);
  journal.end(messages::Ending::kStopped);
  const std::optional<SeaFlight> flight = read_sea_flight(path_);
  ASSERT_TRUE(flight);
  EXPECT_TRUE(flight->is_dated());
  EXPECT_EQ(journal::utc(flight->began), "2026-11-18 11:06:40 UTC");
  EXPECT_EQ(flight->build, "of a test");
  EXPECT_EQ(flight->area.north_east, (NorthEast{Meters{26'000}, Meters{27'000}}));
  ASSERT_EQ(flight->fixes.size(), 1U);
  EXPECT_NEAR(flight->fixes[0].time_s, 60.5, 1e-5) << "seconds since 1970 in a double are exact to a microsecond";
  EXPECT_EQ(flight->fixes[0].position, (NorthEast{Meters{3'000}, Meters{4'000}}));
  ASSERT_EQ(flight->measurements.size(), 1U);
  EXPECT_EQ(flight->measurements[0].snr_db, -3.5);
  EXPECT_TRUE(flight->measurements[0].too_faint);
}

TEST_F(SeaFlightTest, TellsItsOrdersAndStatesAndHowFarItSailedInItsSearchAlone) {
  SeaJournal journal(path_);
  journal.state(1, MissionState::kStandby, EndReason::kNone, 0);
  journal.fix(5, 0, 0);
  journal.acknowledge(10, Order::kStart, CommandOutcome::kObeyed);
  journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
  journal.fix(20, 300, 0);
  journal.fix(30, 300, 400);
  journal.fix(40, 0, 0);  // 400 m and 500 m after the first in the search
  journal.state(50, MissionState::kAbort, EndReason::kNavigationStale, 2);
  journal.fix(60, 9'000, 0);
  journal.end(messages::Ending::kStopped);
  const SeaFlight flight = read_sea_flight(path_).value();
  EXPECT_NEAR(flight.distance().value, 900.0, 1e-9);
  EXPECT_EQ(flight.steps_taken, 2U);
  EXPECT_EQ(flight.counters.snr_refused, 4U);
  EXPECT_EQ(flight.counters.bearings_refused, 2U);
  EXPECT_EQ(flight.counters.bearings_of_others, 3U);
  ASSERT_EQ(flight.events.size(), 3U);
  EXPECT_TRUE(support::tells(flight.events[0].what, {"START", "number 1", "issuer 1", "obeyed"}));
  EXPECT_EQ(flight.events[1].what, "SEARCH");
  EXPECT_TRUE(
      support::tells(flight.events[2].what, {"ABORT", messages::to_string(messages::EndReason::kNavigationStale), "after 2 steps"}));
  EXPECT_NEAR(flight.events[2].time_s, 50.0, 1e-5);
}

TEST_F(SeaFlightTest, TellsAnAnswerThatIsGivenAgainOnceAndHowOften) {
  SeaJournal journal(path_);
  journal.state(1, MissionState::kStandby, EndReason::kNone, 0);
  journal.acknowledge(10, Order::kStart, CommandOutcome::kObeyed);
  journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
  for (int i = 0; i < 10; ++i) journal.acknowledge(11, Order::kStart, CommandOutcome::kObeyed);
  journal.end(messages::Ending::kStopped);
  const SeaFlight flight = read_sea_flight(path_).value();
  ASSERT_EQ(flight.events.size(), 2U);
  EXPECT_TRUE(support::tells(flight.events[0].what, {"START", "number 1", "issuer 1", "obeyed", "11 times"}));
  EXPECT_NEAR(flight.events[0].time_s, 10.0, 1e-5) << "when it was first";
}

TEST_F(SeaFlightTest, TellsThatAnotherProcessWentOnAndHowLongNobodyFlew) {
  SeaJournal journal(path_);
  journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
  journal.fix(20, 300, 0);
  journal.resume(57);
  journal.end(messages::Ending::kStopped);
  const SeaFlight flight = read_sea_flight(path_).value();
  ASSERT_EQ(flight.events.size(), 2U);
  EXPECT_TRUE(support::tells(flight.events[1].what, {"--resume", "before", "killed", "lost", "0 bytes", "behind", "cut", "37 s", "after"}));
  EXPECT_NEAR(flight.events[1].time_s, 57.0, 1e-5);
}

TEST_F(SeaFlightTest, TellsWhichRulesActedAndOnWhatEvidence) {
  SeaJournal journal(path_);
  messages::SafetyEvent battery{.time = {},
                                .rule = 10,
                                .condition = config::Condition::kBattery,
                                .response = config::Response::kReturn,
                                .begins = true,
                                .measure = 14.938,
                                .limit = 15};
  journal.rule(20, battery);
  battery.begins = false;
  journal.rule(30, battery);
  journal.rule(40, {.time = {},
                    .rule = 12,
                    .condition = config::Condition::kLeak,
                    .response = config::Response::kRelease,
                    .begins = true,
                    .measure = 1,
                    .limit = 0});
  journal.rule(50, {.time = {},
                    .rule = 4,
                    .condition = config::Condition::kDepth,
                    .response = config::Response::kAbort,
                    .begins = true,
                    .measure = 412.25,
                    .limit = 400});
  journal.end(messages::Ending::kStopped);
  const SeaFlight flight = read_sea_flight(path_).value();
  ASSERT_EQ(flight.events.size(), 4U);
  EXPECT_EQ(flight.events[0].what, "rule 11, battery_percent: 14.9, below 15.0: return");
  EXPECT_NEAR(flight.events[0].time_s, 20.0, 1e-5);
  EXPECT_EQ(flight.events[1].what, "rule 11, battery_percent: no longer");
  EXPECT_EQ(flight.events[2].what, "rule 13, leak: release");
  EXPECT_EQ(flight.events[3].what, "rule 5, depth_m: 412.2, above 400.0: abort");
}

TEST_F(SeaFlightTest, GivesTheFirstRuleThatSentTheVehicleHomeOrUpInItsSearch) {
  const auto rule = [](std::uint8_t number, config::Response response) {
    return messages::SafetyEvent{.time = {},
                                 .rule = number,
                                 .condition = config::Condition::kBattery,
                                 .response = response,
                                 .begins = true,
                                 .measure = 14.938,
                                 .limit = 15};
  };
  SeaJournal journal(path_);
  journal.rule(5, rule(9, config::Response::kReturn));
  journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
  journal.rule(15, rule(10, config::Response::kSteerBack));
  journal.state(18, MissionState::kSearch, EndReason::kNone, 3);
  journal.rule(20, rule(11, config::Response::kReturn));
  journal.rule(25, rule(12, config::Response::kSurface));
  journal.end(messages::Ending::kStopped);
  EXPECT_TRUE(support::tells(to_string(read_sea_flight(path_).value().account),
                             {"After", "3 steps", "home", "rule 12", "battery_percent", "14.9", "below 15.0", "return"}));
}

TEST_F(SeaFlightTest, GivesARuleThatSentTheVehicleToTheSurfaceAsThat) {
  SeaJournal journal(path_);
  journal.state(10, MissionState::kSearch, EndReason::kNone, 1);
  journal.rule(20, {.time = {},
                    .rule = 12,
                    .condition = config::Condition::kBattery,
                    .response = config::Response::kSurface,
                    .begins = true,
                    .measure = 14.938,
                    .limit = 15});
  journal.end(messages::Ending::kStopped);
  EXPECT_TRUE(support::tells(to_string(read_sea_flight(path_).value().account),
                             {"After", "1 step", "surface", "rule 13", "battery_percent", "14.9", "below 15.0", "surface"}));
}

// A PAUSE that the safety record held, given again by the vehicle itself; then an operator's ABORT.
TEST_F(SeaFlightTest, IsNotStoppedByAnOrderOfItsOwnThatIsNoAbort) {
  SeaJournal journal(path_);
  journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
  journal.own_order(12, Order::kPause);
  journal.state(20, MissionState::kAbort, EndReason::kOperatorAbort, 0);
  journal.end(messages::Ending::kMissionOver);
  EXPECT_EQ(read_sea_flight(path_).value().aborted_by, journal::AbortedBy::kOperator);
}

TEST_F(SeaFlightTest, DrawsTheFixesWhoseSpeedNobodyKnew) {
  SeaJournal journal(path_);
  journal.fix(20, 300, 0, messages::kUnknownSpeed);
  journal.fix(30, 400, 0, MetersPerSecond{std::numeric_limits<double>::infinity()});  // the runtime refuses it
  journal.end(messages::Ending::kStopped);
  const SeaFlight flight = read_sea_flight(path_).value();
  ASSERT_EQ(flight.fixes.size(), 1U);
  EXPECT_EQ(flight.fixes[0].position.north, Meters{300});
}

TEST_F(SeaFlightTest, IsNoneWhereTheJournalDoesNotBeginWithAMission) {
  {
    host::Journal journal(path_);
    ASSERT_EQ(journal.append(Time{1}, "EARSHOT_HEALTH", std::array<std::uint8_t, 3>{1, 2, 3}), Status::kOk);
  }
  EXPECT_FALSE(read_sea_flight(path_));
}

}  // namespace
}  // namespace earshot::report
