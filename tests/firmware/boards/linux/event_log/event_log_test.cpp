#include "firmware/boards/linux/event_log/event_log.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

using messages::EndReason;
using messages::Health;
using messages::MissionState;

constexpr Time kUtc{1'795'000'000'000'000};  // 2026-11-18 11:06:40, as date(1) says

class NamedPort final : public Port {
 public:
  NamedPort(std::uint8_t index, std::string name, bool is_up) : Port(index, {}), name_(std::move(name)) { report_.link_up = is_up; }
  void collect(Clock& /*clock*/, InputSink& /*sink*/) override {}
  std::uint64_t publish(Time /*now*/, const runtime::Outputs& /*outputs*/) override { return 0; }
  [[nodiscard]] int file_descriptor() const override { return -1; }
  [[nodiscard]] PortWords words() const override { return {.label = name_}; }

 private:
  std::string name_;
};

class EventLogTest : public testing::Test {
 protected:
  EventLogTest() {
    ports_.add(std::make_unique<NamedPort>(1, "vehicle, CAN can0", true));
    ports_.add(std::make_unique<NamedPort>(2, "ev\x1bil", false));
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    out_ = host::FileDescriptor(ends[0]);
    in_ = host::FileDescriptor(ends[1]);
    writer_.emplace(in_.number());
    event_log_.emplace(ports_, *writer_);
  }

  static Health health(MissionState state, EndReason reason = EndReason::kNone, std::uint32_t steps = 0) {
    Health health;
    health.state = state;
    health.end_reason = reason;
    health.steps_taken = steps;
    return health;
  }
  /// In the same state, with the link of one port up or down.
  void change_link(double at_s, std::uint8_t port, bool is_up) {
    Health h = health(MissionState::kStandby);
    ASSERT_EQ(h.ports.push_back({.port = port, .link_up = is_up}), Status::kOk);
    event_log_->log(kUtc + Duration{static_cast<std::int64_t>(at_s * 1e6)}, h);
  }
  std::string all_logged() {
    writer_.reset();
    in_ = host::FileDescriptor();
    std::string text(100'000, '\0');
    const ssize_t size = ::read(out_.number(), text.data(), text.size());
    return text.substr(0, static_cast<std::size_t>(size));
  }

  host::FileDescriptor out_;
  host::FileDescriptor in_;
  PortSet ports_;
  std::optional<LineWriter> writer_;
  std::optional<EventLog> event_log_;
};

TEST_F(EventLogTest, TellsEachStateOnceWithItsTimeAndWhyItIsOver) {
  event_log_->log(kUtc, health(MissionState::kStandby));
  event_log_->log(kUtc + Duration::seconds(1), health(MissionState::kStandby));
  event_log_->log(kUtc + Duration::seconds(20), health(MissionState::kSearch));
  event_log_->log(kUtc + Duration::seconds(21), health(MissionState::kSearch, EndReason::kNone, 1));
  event_log_->log(kUtc + Duration::seconds(86'400), health(MissionState::kAbort, EndReason::kNavigationStale, 12));
  EXPECT_TRUE(support::lines_tell(all_logged(), {{"earshotd", "2026-11-18 11:06:40 UTC", "STANDBY"},
                                                 {"earshotd", "2026-11-18 11:07:00 UTC", "SEARCH"},
                                                 {"earshotd", "2026-11-19 11:06:40 UTC", "ABORT",
                                                  messages::to_string(messages::EndReason::kNavigationStale), "after 12 steps"}}));
}

TEST_F(EventLogTest, TellsWhetherASearchCommandsAndIsPausedEachOnce) {
  messages::Health standby = health(MissionState::kStandby);
  standby.authority = messages::Authority::kDisconnected;
  messages::Health search = health(MissionState::kSearch);
  search.authority = messages::Authority::kListen;
  event_log_->log(kUtc, standby);
  event_log_->log(kUtc + Duration::seconds(1), standby);
  standby.authority = messages::Authority::kStandby;
  event_log_->log(kUtc + Duration::seconds(2), standby);
  event_log_->log(kUtc + Duration::seconds(3), search);
  event_log_->log(kUtc + Duration::seconds(4), search);
  search.authority = messages::Authority::kCommand;
  event_log_->log(kUtc + Duration::seconds(5), search);
  search.is_paused = true;
  event_log_->log(kUtc + Duration::seconds(6), search);
  search.state = MissionState::kAbort;
  search.end_reason = EndReason::kOperatorAbort;
  event_log_->log(kUtc + Duration::seconds(7), search);
  EXPECT_TRUE(support::lines_tell(all_logged(), {{"earshotd", "2026-11-18 11:06:40 UTC", "STANDBY", "not heard"},
                                                 {"earshotd", "2026-11-18 11:06:42 UTC", "STANDBY"},
                                                 {"earshotd", "2026-11-18 11:06:43 UTC", "SEARCH", "listening"},
                                                 {"earshotd", "2026-11-18 11:06:45 UTC", "SEARCH"},
                                                 {"earshotd", "2026-11-18 11:06:46 UTC", "SEARCH", "paused"},
                                                 {"earshotd", "2026-11-18 11:06:47 UTC", "ABORT",
                                                  messages::to_string(messages::EndReason::kOperatorAbort), "after 0 steps"}}));
}

TEST_F(EventLogTest, IsNotFloodedByAnAutopilotThatComesAndGoes) {
  messages::Health standby = health(MissionState::kStandby);
  for (int s = 0; s < 40; ++s) {
    standby.authority = s % 2 == 0 ? messages::Authority::kDisconnected : messages::Authority::kStandby;
    event_log_->log(kUtc + Duration::seconds(s), standby);
  }
  const std::string told = all_logged();
  EXPECT_EQ(std::ranges::count(told, '\n'), 8) << "the state, four at once, and one every 10 s\n" << told;
}

TEST_F(EventLogTest, IsNotFloodedByALimitThatEndedTheMissionAndIsPassedAgainAndAgain) {
  for (int s = 0; s < 40; ++s)
    event_log_->log(messages::SafetyEvent{.time = kUtc + Duration::seconds(s),
                                          .rule = 4,
                                          .condition = config::Condition::kDepth,
                                          .response = config::Response::kAbort,
                                          .begins = s % 2 == 1,
                                          .measure = 301,
                                          .limit = 300});
  const std::string told = all_logged();
  EXPECT_LE(std::ranges::count(told, '\n'), 6) << told;
  EXPECT_NE(told.find("11:06:41 UTC: rule 5, "), std::string::npos) << "the first end is told at once\n" << told;
}

TEST_F(EventLogTest, TellsWhatARuleDoesAndWhyAndWhenItNoLongerDoes) {
  messages::SafetyEvent event{.time = kUtc,
                              .rule = 10,
                              .condition = config::Condition::kBattery,
                              .response = config::Response::kReturn,
                              .begins = true,
                              .measure = 14.94,
                              .limit = 15};
  event_log_->log(event);
  event.begins = false;
  event.time = kUtc + Duration::seconds(10);
  event_log_->log(event);
  event_log_->log(messages::SafetyEvent{.time = kUtc + Duration::seconds(11),
                                        .rule = 4,
                                        .condition = config::Condition::kDepth,
                                        .response = config::Response::kAbort,
                                        .begins = true,
                                        .measure = 900.26,
                                        .limit = 320});
  event_log_->log(messages::SafetyEvent{.time = kUtc + Duration::seconds(12),
                                        .rule = 4,
                                        .condition = config::Condition::kLeak,
                                        .response = config::Response::kRelease,
                                        .begins = true,
                                        .measure = 1,
                                        .limit = 0});
  EXPECT_TRUE(support::lines_tell(all_logged(),
                                  {{"earshotd", "2026-11-18 11:06:40 UTC", "rule 11", "battery_percent", "14.9", "below 15.0", "return"},
                                   {"earshotd", "2026-11-18 11:06:50 UTC", "rule 11", "battery_percent", "no"},
                                   {"earshotd", "2026-11-18 11:06:51 UTC", "rule 5", "depth_m", "900.3", "above 320.0", "abort"},
                                   {"earshotd", "2026-11-18 11:06:52 UTC", "rule 5", "leak", "release"}}));
}

messages::SafetyEvent too_deep(int second, bool begins) {
  return {.time = kUtc + Duration::seconds(second),
          .rule = 11,
          .condition = config::Condition::kDepth,
          .response = config::Response::kHold,
          .begins = begins,
          .measure = begins ? 310.0 : 299.0,
          .limit = 300};
}

TEST_F(EventLogTest, SaysLastOfARuleThatComesAndGoesWhatItDoes) {
  const auto pass = [this](int from, int to) {
    for (int second = from; second <= to; ++second) event_log_->log(kUtc + Duration::seconds(second), health(MissionState::kSearch));
  };
  event_log_->log(too_deep(0, true));
  pass(0, 2);
  event_log_->log(too_deep(3, false));
  pass(3, 5);
  event_log_->log(too_deep(6, true));
  pass(6, 30);
  event_log_->log(too_deep(31, false));
  event_log_->log(too_deep(35, true));
  pass(35, 60);
  EXPECT_TRUE(support::lines_tell(all_logged(),
                                  {{"earshotd", "2026-11-18 11:06:40 UTC", "rule 12", "depth_m", "310.0", "above 300.0", "hold"},
                                   {"earshotd", "2026-11-18 11:06:40 UTC", "SEARCH"},
                                   {"earshotd", "2026-11-18 11:06:50 UTC", "rule 12", "depth_m", "310.0", "above 300.0", "hold", "2 times"},
                                   {"earshotd", "2026-11-18 11:07:11 UTC", "rule 12", "depth_m", "no"},
                                   {"earshotd", "2026-11-18 11:07:21 UTC", "rule 12", "depth_m", "310.0", "above 300.0", "hold"}}));
}

TEST_F(EventLogTest, MakesUpForALineOfARuleThatCameTooSoonAfterItsLast) {
  event_log_->log(too_deep(0, true));
  event_log_->log(too_deep(3, false));
  event_log_->log(kUtc + Duration::seconds(9), health(MissionState::kSearch));
  event_log_->log(kUtc + Duration::seconds(10), health(MissionState::kSearch));
  EXPECT_TRUE(
      support::lines_tell(all_logged(), {{"earshotd", "2026-11-18 11:06:40 UTC", "rule 12", "depth_m", "310.0", "above 300.0", "hold"},
                                         {"earshotd", "2026-11-18 11:06:49 UTC", "SEARCH"},
                                         {"earshotd", "2026-11-18 11:06:50 UTC", "rule 12", "depth_m", "no"}}));
}

TEST_F(EventLogTest, TellsThatAnOperatorMadeTheLimitsTighterAndLastWhatTheyAre) {
  config::Mission mission;
  mission.search_depth = Meters{300};
  mission.max_depth = Meters{400};
  mission.search_speed = MetersPerSecond{2};
  mission.max_time = Duration::seconds(60'000);
  event_log_->log(Time{}, mission);
  event_log_->log(kUtc, mission);
  mission.search_depth = Meters{187.5};
  mission.max_depth = Meters{250};
  for (int second = 1; second <= 3; ++second) event_log_->log(kUtc + Duration::seconds(second), mission);
  mission.search_speed = MetersPerSecond{1.25};
  mission.max_time = Duration::seconds(3600);
  for (int second = 4; second <= 20; ++second) event_log_->log(kUtc + Duration::seconds(second), mission);
  EXPECT_TRUE(support::lines_tell(
      all_logged(),
      {{"earshotd", "2026-11-18 11:06:41 UTC", "TIGHTEN", "obeyed", "187.5 m", "2.00 m/s", "never below 250.0 m", "after 60000 s"},
       {"earshotd", "2026-11-18 11:06:51 UTC", "TIGHTEN", "obeyed", "187.5 m", "1.25 m/s", "never below 250.0 m", "after 3600 s"}}));
}

TEST_F(EventLogTest, TellsTheSecondsOfASimulatorsClock) {
  event_log_->log(Time{4'711'900'000}, health(MissionState::kDone, EndReason::kCompleted, 37));
  EXPECT_TRUE(support::lines_tell(
      all_logged(), {{"earshotd", "4711 s", "DONE", messages::to_string(messages::EndReason::kCompleted), "after 37 steps"}}));
}

TEST_F(EventLogTest, TellsEveryLinkThatGoesDownOrComesBackButNotWhatWasDownAtTheStart) {
  change_link(0, 2, false);
  change_link(1, 1, true);
  change_link(2, 1, false);
  change_link(3, 1, false);
  change_link(15, 1, true);
  change_link(16, 2, true);
  EXPECT_EQ(all_logged(),
            "earshotd: 2026-11-18 11:06:40 UTC: STANDBY\n"
            "earshotd: 2026-11-18 11:06:42 UTC: port 1, vehicle, CAN can0: its link is down; tried again once a second\n"
            "earshotd: 2026-11-18 11:06:55 UTC: port 1, vehicle, CAN can0: its link is up again\n"
            "earshotd: 2026-11-18 11:06:56 UTC: port 2, ev\\x1bil: its link is up again\n");
}

TEST_F(EventLogTest, TellsOnceThatTheDiskDoesNotTakeTheJournalAndOnceThatItDoesAgain) {
  change_link(0, kOwnPort, true);
  change_link(1, kOwnPort, false);
  change_link(2, kOwnPort, false);
  Health h = health(MissionState::kStandby);
  ASSERT_EQ(h.ports.push_back({.port = kOwnPort, .lost = 12}), Status::kOk);
  event_log_->log(kUtc + Duration::seconds(62), h);
  EXPECT_TRUE(
      support::lines_tell(all_logged(), {{"earshotd", "2026-11-18 11:06:40 UTC", "STANDBY"},
                                         {"earshotd", "2026-11-18 11:06:41 UTC", "journal", "not", "once", "only", "changes", "kept"},
                                         {"earshotd", "2026-11-18 11:07:42 UTC", "journal", "12 records", "lost"}}));
}

TEST_F(EventLogTest, TellsInEachStateOnceHowManyMessagesWereRefusedAndWhereToLook) {
  const auto turn = [this](int second, MissionState state, const messages::Counters& counters) {
    Health h = health(state, state == MissionState::kAbort ? EndReason::kNavigationStale : EndReason::kNone, 2);
    h.counters = counters;
    event_log_->log(kUtc + Duration::seconds(second), h);
  };
  turn(1, MissionState::kStandby, {.snr_refused = 1});
  turn(2, MissionState::kStandby, {.snr_refused = 2});
  turn(3, MissionState::kSearch, {.snr_refused = 2});
  turn(4, MissionState::kSearch, {.navigation_refused = 1, .snr_refused = 2});
  turn(5, MissionState::kSearch, {.navigation_refused = 2, .snr_refused = 2});
  turn(14, MissionState::kAbort, {.navigation_refused = 31, .snr_refused = 2});
  for (const std::uint64_t n : {0U, 7U, 8U})
    turn(16, MissionState::kAbort, {.navigation_refused = 32, .snr_refused = 2, .bearings_refused = n + 1, .bearings_of_others = n});
  EXPECT_TRUE(support::lines_tell(all_logged(),
                                  {{"2026-11-18 11:06:41 UTC", "STANDBY"},
                                   {"2026-11-18 11:06:41 UTC", "SNR", "1 message", "refused", "sender's clock"},
                                   {"2026-11-18 11:06:43 UTC", "SEARCH"},
                                   {"2026-11-18 11:06:43 UTC", "SNR", "2 messages", "refused"},
                                   {"2026-11-18 11:06:44 UTC", "navigation", "1 message", "refused"},
                                   {"2026-11-18 11:06:54 UTC", "ABORT", messages::to_string(EndReason::kNavigationStale), "after 2 steps"},
                                   {"2026-11-18 11:06:54 UTC", "navigation", "31 messages", "refused"},
                                   {"2026-11-18 11:06:56 UTC", "bearing", "1 message", "refused"},
                                   {"2026-11-18 11:06:56 UTC", "bearing", "7 messages", "second sender", "120 s"}}));
}

TEST_F(EventLogTest, TellsALinkThatComesAndGoesFourTimesAndThenOnceInTenSecondsAndHowOftenItChanged) {
  for (int second = 0; second < 25; ++second) change_link(second, 1, second % 2 == 1);
  change_link(60, 1, false);
  change_link(61, 1, true);
  const std::string link = "port 1, vehicle, CAN can0: its link is ";
  EXPECT_TRUE(
      support::lines_tell(all_logged(), {{"earshotd", "2026-11-18 11:06:40 UTC", link, "down", "tried", "again", "once", "second"},
                                         {"earshotd", "2026-11-18 11:06:40 UTC", "STANDBY"},
                                         {"earshotd", "2026-11-18 11:06:41 UTC", link, "up again"},
                                         {"earshotd", "2026-11-18 11:06:42 UTC", link, "down", "tried", "again", "once", "second"},
                                         {"earshotd", "2026-11-18 11:06:43 UTC", link, "up again"},
                                         {"earshotd", "2026-11-18 11:06:50 UTC", link, "down", "once", "changed", "7 times", "reported"},
                                         {"earshotd", "2026-11-18 11:07:00 UTC", link, "down", "once", "changed", "10 times", "reported"},
                                         {"earshotd", "2026-11-18 11:07:40 UTC", link, "down", "once", "changed", "4 times", "reported"},
                                         {"earshotd", "2026-11-18 11:07:41 UTC", link, "up again"}}));
}

TEST_F(EventLogTest, TellsASoundThatWasHeardAndThenOnceAMinuteHowManySince) {
  messages::SoundDetection detection{
      .begin = kUtc, .duration = Duration::milliseconds(1250), .level = Decibels{104.24}, .snr = Decibels{14.06}, .is_clipped = true};
  event_log_->log(kUtc + Duration::seconds(3), 1, detection);
  detection.is_clipped = false;
  event_log_->log(kUtc + Duration::seconds(18), 1, detection);
  event_log_->log(kUtc + Duration::seconds(64), 1, detection);
  EXPECT_TRUE(support::lines_tell(all_logged(), {{"earshotd", "2026-11-18 11:06:43 UTC", "heard", "1.2 s", "2026-11-18 11:06:40 UTC",
                                                  "104.2 dB", "SNR", "14.1 dB", "clipped"},
                                                 {"earshotd", "2026-11-18 11:07:44 UTC", "heard", "1.2 s", "2026-11-18 11:06:40 UTC",
                                                  "104.2 dB", "SNR", "14.1 dB", "2 detections"}}));
}

TEST_F(EventLogTest, TellsAtTheNextTurnWithWhatChainAHydrophoneIsHeardAndNotMoreThanOnceInTenSeconds) {
  HeardChain chain{.band = {},
                   .sample_rate = Hertz{96'000},
                   .channels = 8,
                   .full_scale_level = Decibels{180},
                   .adc_noise_level = Decibels{-10.34},
                   .delay_s = 0.241};
  const Health standby = health(MissionState::kStandby);
  event_log_->log(kUtc, standby);
  event_log_->log(1, chain);
  event_log_->log(kUtc, standby);
  chain.channels = 1;
  event_log_->log(1, chain);
  event_log_->log(kUtc + Duration::seconds(9), standby);
  chain.heard = HeardChain::Heard::kRateTooLow;
  chain.sample_rate = Hertz{50};
  event_log_->log(1, chain);
  event_log_->log(kUtc + Duration::seconds(10), standby);
  chain.heard = HeardChain::Heard::kImpossibleChain;
  chain.fault = detector::CalibrationFault::kBits;
  event_log_->log(1, chain);
  event_log_->log(kUtc + Duration::seconds(20), standby);
  EXPECT_TRUE(support::lines_tell(
      all_logged(), {{"earshotd", "2026-11-18 11:06:40 UTC", "STANDBY"},
                     {"earshotd", "2026-11-18 11:06:40 UTC", "port 1", "CAN", "can0", "15.0 to 30.0 Hz", "8 channels", "96000.0", "Hz",
                      "180.0", "-10.3 dB", "SNR", "0.24 s"},
                     {"earshotd", "2026-11-18 11:06:50 UTC", "port 1", "CAN", "can0", "nothing", "50.0 Hz", "too", "up", "30.0 Hz"},
                     {"earshotd", "2026-11-18 11:07:00 UTC", "port 1", "CAN", "can0", "nothing", "ADC", "8 to 32 bits"}}));
}

TEST_F(EventLogTest, TellsAnAbortOfItsOwnFromAnOperators) {
  event_log_->note_program_stop();
  event_log_->log(kUtc, health(MissionState::kAbort, EndReason::kOperatorAbort, 3));
  EXPECT_TRUE(support::lines_tell(all_logged(), {{"earshotd", "2026-11-18 11:06:40 UTC", "ABORT", "stopped", "after 3 steps"}}));
}

TEST_F(EventLogTest, TellsWhatIsWrongWithACanBusAndWhenItIsOver) {
  event_log_->log(1, BusTrouble::kNoPosition, true);
  event_log_->log(2, BusTrouble::kNoVariation, true);
  event_log_->log(kUtc, health(MissionState::kStandby));
  event_log_->log(kUtc + Duration::seconds(1), health(MissionState::kStandby));
  event_log_->log(1, BusTrouble::kNoPosition, false);
  event_log_->log(2, BusTrouble::kNoVariation, false);  // its end goes without saying
  event_log_->log(kUtc + Duration::seconds(10), health(MissionState::kStandby));
  EXPECT_EQ(all_logged(),
            "earshotd: 2026-11-18 11:06:40 UTC: port 1, vehicle, CAN can0: no position is heard (129025, 129029)\n"
            "earshotd: 2026-11-18 11:06:40 UTC: port 2, ev\\x1bil: headings are magnetic, and nobody gives the variation (127258)\n"
            "earshotd: 2026-11-18 11:06:40 UTC: STANDBY\n"
            "earshotd: 2026-11-18 11:06:50 UTC: port 1, vehicle, CAN can0: positions are heard\n");
}

TEST_F(EventLogTest, TellsATroubleThatComesAndGoesOnceInTenSecondsAtMostAndAsItIsThen) {
  for (int tenth = 0; tenth <= 250; ++tenth) {
    event_log_->log(1, BusTrouble::kErrorPassive, tenth % 2 == 0);
    event_log_->log(kUtc + Duration::milliseconds(100 * tenth), health(MissionState::kStandby));
  }
  const std::string told = all_logged();
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1 + 3) << told;  // STANDBY; at 0, 10.1 and 20.2 s
}

TEST_F(EventLogTest, HasRoomForTheWordsOfEveryTrouble) {
  for (std::size_t i = 0; i < kBusTroubleCount; ++i) {
    const auto trouble = static_cast<BusTrouble>(i);
    EXPECT_FALSE(begin_of(trouble).empty()) << i;
    // A date and a port's name take 80 characters.
    EXPECT_LT(begin_of(trouble).size() + 80, LineWriter::kLineBytes) << begin_of(trouble);
  }
}

}  // namespace
}  // namespace earshot::board
