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
  journal.snr(62.0, -7.0);
  journal.end(messages::Ending::kStopped);
  const std::optional<SeaFlight> flight = read_sea_flight(path_);
  ASSERT_TRUE(flight);
  EXPECT_TRUE(flight->is_dated());
  EXPECT_EQ(journal::utc(flight->began), "2026-11-18 11:06:40 UTC");
  EXPECT_EQ(flight->build, "of a test");
  EXPECT_EQ(flight->area.north_east, (NorthEast{Meters{26'000}, Meters{27'000}}));
  EXPECT_EQ(flight->fixes, 1U);
  EXPECT_EQ(flight->measurements, 2U);
  EXPECT_EQ(flight->loudest_db, -7.0) << "of the other it is only known that it is fainter than -3.5 dB";
  EXPECT_NEAR(flight->ended_s, 62.0, 1e-5) << "seconds since 1970 in a double are exact to a microsecond";
}

TEST_F(SeaFlightTest, TellsHowFarItSailedInItsSearchAlone) {
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
  journal.state(70, MissionState::kSearch, EndReason::kNone, 2);
  journal.fix(80, 20'000, 0);  // the first of another search
  journal.end(messages::Ending::kStopped);
  const SeaFlight flight = read_sea_flight(path_).value();
  EXPECT_NEAR(flight.sailed.value, 900.0, 1e-9);
  EXPECT_EQ(flight.steps_taken, 2U);
  EXPECT_EQ(flight.counters.snr_refused, 4U);
  EXPECT_EQ(flight.counters.bearings_refused, 2U);
  EXPECT_EQ(flight.counters.bearings_of_others, 3U);
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

TEST_F(SeaFlightTest, CountsTheFixesWhoseSpeedNobodyKnew) {
  SeaJournal journal(path_);
  journal.fix(20, 300, 0, messages::kUnknownSpeed);
  journal.fix(30, 400, 0, MetersPerSecond{std::numeric_limits<double>::infinity()});  // the runtime refuses it
  journal.end(messages::Ending::kStopped);
  EXPECT_EQ(read_sea_flight(path_).value().fixes, 1U);
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
