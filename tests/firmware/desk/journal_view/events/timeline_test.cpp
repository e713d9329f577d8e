#include "firmware/desk/journal_view/events/timeline.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "firmware/host/journal/reading/record_source.hpp"
#include "firmware/messages/dictionary/health_words.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::journal {
namespace {

using Severity = Event::Severity;

messages::VehicleStatus status(bool has_leak, bool has_ground_fault) {
  messages::VehicleStatus status;
  status.has_leak = has_leak;
  status.has_ground_fault = has_ground_fault;
  return status;
}

Entry record_of(const Content& content) {
  return Record{.number = 0, .time = kBegan, .channel = {}, .size_bytes = 0, .content = content};
}

/// What a timeline tells of records that a test makes.
class TimelineTest : public ::testing::Test {
 protected:
  std::vector<std::string> events_of(const Entry& entry) {
    std::vector<std::string> lines;
    for (const Event& event : timeline_.take(entry)) lines.push_back(event.text);
    return lines;
  }
  std::vector<std::string> events_of(const Content& content) { return events_of(record_of(content)); }
  template <class Value>
  std::vector<std::string> events_of_input(const Value& value) {
    return events_of(Content(messages::Input{.arrival = kBegan, .port = 1, .sequence = 0, .value = value}));
  }

  Timeline timeline_;
};
using Lines = std::vector<std::string>;

TEST_F(TimelineTest, TellsAKnownMissionLineByLine) {
  const support::TemporaryFolder folder;
  write_known_journal(folder / "journal");
  RecordSource source(folder / "journal");
  std::string text;
  while (const std::optional<Entry> entry = source.next())
    for (const Event& event : timeline_.take(*entry)) text += to_line(event, timeline_.began()) + "\n";
  EXPECT_TRUE(timeline_.finish(source.torn_end()).empty());
  EXPECT_TRUE(support::lines_tell(
      text,
      {{"2026-11-22 15:04:00 UTC", "0.0 s", "begins", "25.0 km", "20.0 km", "300 m", "2.0 m/s", "up", "100 steps", "1000 m", "60000 s",
        "threshold", "10.0 dB", "0.1.0", "abc"},
       {"2026-11-22 15:04:00 UTC", "0.0 s", "policy", "3 bytes", "CRC-32", "55bc801d"},
       {"2026-11-22 15:04:01 UTC", "1.0 s", "STANDBY"},
       {"2026-11-22 15:04:01 UTC", "1.5 s", "START", "number 1", "issuer 77", "port 2"},
       {"2026-11-22 15:04:02 UTC", "2.0 s", "step 0", "SNR", "12.2 dB", "detection", "1000 m north", "2000 m east", "1000 m", "270 deg"},
       {"2026-11-22 15:04:02 UTC", "2.0 s", "START", "number 1", "issuer 77", "obeyed"},
       {"2026-11-22 15:04:02 UTC", "2.0 s", "SEARCH"},
       {"2026-11-22 15:04:02 UTC", "2.9 s", "port 2", "down"},
       {"2026-11-22 15:04:03 UTC", "3.9 s", "port 2", "up"},
       {"2026-11-22 15:04:03 UTC", "3.9 s", "port 2", "2", "lost", "0 malformed", "0", "not"},
       {"2026-11-22 15:04:04 UTC", "4.0 s", "rule 11", "battery_percent", "14.9", "below 15.0", "abort"},
       {"2026-11-22 15:04:04 UTC", "4.0 s", "ABORT", messages::to_string(messages::EndReason::kSafetyRule), "after 1 step"},
       {"2026-11-22 15:04:04 UTC", "4.0 s", "end", "ABORT", messages::to_string(messages::EndReason::kSafetyRule), "after 1 step", "no",
        "lost"}}));
}

TEST(TimelineLine, HasNoDateOnASimulatorsClock) {
  EXPECT_EQ(to_line({.severity = Severity::kWarning, .time = Time{1'500'000}, .text = "SEARCH"}, Time{}), "      1.5 s  SEARCH");
}

TEST_F(TimelineTest, TellsAStateOnceHoweverLongItLasts) {
  messages::Health health;
  health.state = messages::MissionState::kSearch;
  health.authority = messages::Authority::kCommand;
  EXPECT_EQ(events_of(health), Lines{"SEARCH"});
  EXPECT_EQ(events_of(health), Lines{});
  health.is_paused = true;
  EXPECT_EQ(events_of(health), Lines{"SEARCH, paused by an operator"});
}

TEST_F(TimelineTest, TellsOnceInASearchThatItHasAMismatchAndWhenItBeginsToSweep) {
  messages::Health health;
  health.state = messages::MissionState::kSearch;
  health.authority = messages::Authority::kCommand;
  health.mismatch_bits = 6.7F;
  EXPECT_EQ(events_of(health), Lines{"SEARCH"});
  health.mismatch_bits = 6.75F;
  EXPECT_TRUE(support::lines_tell(events_of(health), {{messages::kIsMismatched, "model-mismatch", "score", "6.8 bits"}}));
  health.mismatch_bits = 5.0F;
  EXPECT_EQ(events_of(health), Lines{});
  health.mismatch_bits = 7.0F;
  EXPECT_EQ(events_of(health), Lines{});
  health.is_sweeping = true;
  EXPECT_TRUE(support::lines_tell(events_of(health), {{"SEARCH", messages::kSweeps}}));
  EXPECT_EQ(events_of(health), Lines{});
  health = {};
  (void)events_of(health);
  health.state = messages::MissionState::kSearch;
  health.mismatch_bits = 7.0F;
  EXPECT_EQ(events_of(health).size(), 2U) << "another search";
}

TEST_F(TimelineTest, TellsThatASearchSweepsBecauseItHasHeardNothingWhereNoMismatchIs) {
  messages::Health health;
  health.state = messages::MissionState::kSearch;
  health.authority = messages::Authority::kCommand;
  (void)events_of(health);
  health.is_sweeping = true;
  EXPECT_TRUE(support::lines_tell(events_of(health), {{"SEARCH", messages::kSweepsInSilence}}));
  health.is_sweeping = false;
  EXPECT_EQ(events_of(health), Lines{"SEARCH"}) << "something is heard";
}

// Who gives an order sends it until it is answered, and each time it comes it is answered.
TEST_F(TimelineTest, TellsAnOrderThatIsSentAgainAndAgainOnceAndHowOften) {
  messages::OperatorCommand start;
  start.order = messages::Order::kStart;
  start.issuer = 77;
  start.number = 1;
  messages::CommandAcknowledgement obeyed;
  obeyed.order = messages::Order::kStart;
  obeyed.issuer = 77;
  obeyed.number = 1;
  const std::string order = "order START, number 1 of issuer 77, by port 1";
  const std::string answer = "order START, number 1 of issuer 77: obeyed";
  EXPECT_EQ(events_of_input(start), Lines{order});
  EXPECT_EQ(events_of(obeyed), Lines{answer});
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(events_of_input(start), Lines{});
    EXPECT_EQ(events_of(obeyed), Lines{});
  }
  messages::Health health;
  health.state = messages::MissionState::kSearch;
  health.authority = messages::Authority::kCommand;
  EXPECT_EQ(events_of(health), (Lines{order + " (11 times)", answer + " (11 times)", "SEARCH"}));
  EXPECT_EQ(events_of_input(start), Lines{});
  start.number = 2;
  EXPECT_TRUE(support::lines_tell(events_of_input(start), {{order, "12", "times"}, {"START", "number 2", "issuer 77", "port 1"}}));
  (void)events_of(obeyed);
  const std::vector<Event> end = timeline_.finish(std::nullopt);
  ASSERT_EQ(end.size(), 2U);
  EXPECT_EQ(end[0].text, answer + " (12 times)");
}

/// What is told of the state and of the end when an ABORT ended the mission.
messages::Health aborted() {
  messages::Health health;
  health.state = messages::MissionState::kAbort;
  health.authority = messages::Authority::kAbort;
  health.end_reason = messages::EndReason::kOperatorAbort;
  health.steps_taken = 2;
  return health;
}

TEST_F(TimelineTest, TellsAProgramThatWasStoppedFromAnOperatorsAbort) {
  const auto order_by = [this](std::uint8_t port, messages::Order order) {
    messages::OperatorCommand command;
    command.order = order;
    (void)events_of(Content(messages::Input{.arrival = kBegan, .port = port, .sequence = 0, .value = command}));
  };
  const auto abort_by = [&order_by](std::uint8_t port) { order_by(port, messages::Order::kAbort); };
  const messages::ClosingRecord closing{.time = kBegan,
                                        .ending = messages::Ending::kStopped,
                                        .state = messages::MissionState::kAbort,
                                        .end_reason = messages::EndReason::kOperatorAbort,
                                        .steps_taken = 2};
  order_by(0, messages::Order::kPause);  // that the safety record held, given again by the vehicle itself
  abort_by(1);
  EXPECT_TRUE(
      support::lines_tell(events_of(aborted()), {{"ABORT", messages::to_string(messages::EndReason::kOperatorAbort), "after 2 steps"}}));
  abort_by(0);  // it was over before
  EXPECT_TRUE(support::lines_tell(
      events_of(closing),
      {{"end", "program", "stopped", "ABORT", messages::to_string(messages::EndReason::kOperatorAbort), "after 2 steps", "no", "lost"}}));
  timeline_ = Timeline();
  abort_by(0);
  EXPECT_TRUE(support::lines_tell(events_of(aborted()), {{"ABORT", "program", "stopped", "after 2 steps"}}));
  EXPECT_TRUE(support::lines_tell(events_of(closing), {{"end", "stopped", "ABORT", "stopped", "after 2 steps", "no", "lost"}}));
}

TEST_F(TimelineTest, TellsWhatIsRefusedOnceInAState) {
  messages::Health health;
  health.authority = messages::Authority::kCommand;
  (void)events_of(health);
  health.counters.navigation_refused = 3;
  EXPECT_TRUE(support::lines_tell(events_of(health), {{"navigation", "3 messages", "refused"}}));
  health.counters.navigation_refused = 4;
  EXPECT_EQ(events_of(health), Lines{});
  health.state = messages::MissionState::kSearch;
  health.counters.snr_refused = 1;
  EXPECT_TRUE(support::lines_tell(events_of(health), {{"SEARCH"}, {"SNR", "1 message", "refused"}}));
  health.counters.navigation_refused = 5;
  EXPECT_EQ(events_of(health).size(), 1U);
}

TEST_F(TimelineTest, TellsBearingsThatAreRefusedApartFromThoseOfASecondSender) {
  messages::Health health;
  health.authority = messages::Authority::kCommand;
  (void)events_of(health);
  health.counters.bearings_refused = 2;
  EXPECT_TRUE(support::lines_tell(events_of(health), {{"bearing", "2 messages", "refused"}}));
  health.counters.bearings_of_others = 1;
  EXPECT_TRUE(support::lines_tell(events_of(health), {{"bearing", "1 message", "not"}}));
  health.counters.bearings_refused = health.counters.bearings_of_others = 3;
  EXPECT_EQ(events_of(health), Lines{});
}

TEST_F(TimelineTest, SaysThatADiskDoesNotTakeTheJournal) {
  EXPECT_EQ(events_of_input(messages::PortReport{.port = 0, .link_up = true}), Lines{});
  EXPECT_EQ(events_of_input(messages::PortReport{.port = 0, .link_up = false}), Lines{"journal: the disk does not take it in time"});
  EXPECT_EQ(events_of_input(messages::PortReport{.port = 0, .link_up = true}), Lines{"journal: the disk takes it again"});
}

TEST_F(TimelineTest, SaysHowManySetpointsCouldNotBeSent) {
  EXPECT_EQ(events_of_input(messages::UnsentSetpoints{.count = 1}), Lines{"so far 1 set-point could not be sent"});
}

TEST_F(TimelineTest, LeavesOutAPortThatNoMissionHas) {
  EXPECT_EQ(events_of_input(messages::PortReport{.port = 255, .link_up = false, .lost = 3}), Lines{});
}

TEST_F(TimelineTest, TellsWhatComesOverTheVehicleAndGoesAgain) {
  EXPECT_EQ(events_of_input(status(false, false)), Lines{});
  EXPECT_EQ(events_of_input(status(true, true)), (Lines{"water in the hull", "a ground fault"}));
  EXPECT_EQ(events_of_input(status(false, true)), Lines{"no more water in the hull"});
  EXPECT_EQ(events_of_input(messages::HydrophoneStatus{.time = kBegan, .is_deaf = true}), Lines{"the hydrophone is deaf"});
  EXPECT_EQ(events_of_input(messages::HydrophoneStatus{.time = kBegan, .is_deaf = false}), Lines{"the hydrophone hears again"});
  EXPECT_EQ(events_of_input(messages::AutopilotStatus{.time = kBegan, .follows_setpoints = false}),
            Lines{"the autopilot follows no set-points"});
  EXPECT_EQ(events_of_input(messages::AutopilotStatus{.time = kBegan, .follows_setpoints = true}),
            Lines{"the autopilot follows set-points"});
  EXPECT_EQ(events_of_input(messages::AutopilotStatus{.time = kBegan, .follows_setpoints = true}), Lines{});
}

TEST_F(TimelineTest, TellsThatTheDropWeightIsToGo) {
  EXPECT_EQ(events_of(some_setpoint()), Lines{});
  EXPECT_EQ(events_of(some_setpoint(true)), Lines{"the drop weight is asked to be released"});
  EXPECT_EQ(events_of(some_setpoint(true)), Lines{});
}

TEST_F(TimelineTest, MindsAPolicyThatIsNotTheMissions) {
  (void)events_of(known_mission());
  const std::vector<Event> events = timeline_.take(record_of(PolicyBytes{.bytes = {7, 8, 9}, .crc32 = 0x12}));
  ASSERT_EQ(events.size(), 1U);
  EXPECT_TRUE(events[0].is_lack);
  EXPECT_TRUE(support::tells(events[0].text, {"policy", "3 bytes", "CRC-32", "00000012", "not", "55bc801d"}));
}

TEST_F(TimelineTest, TellsTheFirstOfTheRecordsThatItCannotRead) {
  const Record record{
      .number = 5, .time = kBegan, .channel = "EARSHOT_HEALTH", .size_bytes = 1, .content = Unreadable{.is_known_channel = true}};
  EXPECT_TRUE(support::lines_tell(events_of(Entry(record)), {{"5", "EARSHOT_HEALTH", "cannot", "read"}}));
  EXPECT_EQ(events_of(Entry(record)), Lines{});
}

TEST_F(TimelineTest, SaysWhatIsMissingAtTheEndAndThatItIsALack) {
  const std::vector<Event> events = timeline_.finish(TornEnd{.where = {.offset = 90, .bytes = 12}, .is_cut = true});
  ASSERT_EQ(events.size(), 2U);
  EXPECT_TRUE(events[0].is_lack && events[1].is_lack);
  EXPECT_EQ(events[0].severity, Severity::kError);
  EXPECT_EQ(events[1].text.find("the journal's end is missing"), 0U);
}

TEST_F(TimelineTest, CountsRecordsThatAreLostAsALack) {
  const std::vector<Event> events = timeline_.take(record_of(messages::ClosingRecord{.time = kBegan, .lost = {.streams = 1}}));
  ASSERT_EQ(events.size(), 1U);
  EXPECT_TRUE(events[0].is_lack);
  EXPECT_TRUE(timeline_.is_closed());
}

TEST_F(TimelineTest, WarnsOfARuleThatActsAndNotOfOneThatEnds) {
  using enum config::Response;
  constexpr auto kLeak = config::Condition::kLeak;
  EXPECT_EQ(timeline_.take(record_of(event_of(kLeak, kHold))).at(0).severity, Severity::kWarning);
  EXPECT_EQ(timeline_.take(record_of(event_of(kLeak, kAbort))).at(0).severity, Severity::kError);
  EXPECT_EQ(timeline_.take(record_of(event_of(kLeak, kAbort, false))).at(0).severity, Severity::kInformation);
}

}  // namespace
}  // namespace earshot::journal
