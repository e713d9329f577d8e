#include "firmware/boards/linux/mission_loop.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "firmware/boards/linux/journal_reader.hpp"
#include "firmware/boards/linux/lcm_codec.hpp"
#include "firmware/boards/linux/messages.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::board {
namespace {

namespace fs = std::filesystem;
using runtime::MissionState;
using runtime::OperatorCommand;

constexpr Duration kPeriod = Duration::seconds(1);
constexpr SeaTiming kTiming{
    .period = kPeriod, .navigation_timeout = Duration::seconds(5), .snr_timeout = Duration::seconds(30)};  // of paper_mission()
constexpr Time kUtc{1'795'000'000'000'000};                                                                ///< when a test begins

Duration seconds(double s) {
  return {std::llround(s * 1e6)};
}

/// A host's clocks in the test's hand.
class FakeClock final : public HostClock {
 public:
  [[nodiscard]] Time utc() const override { return utc_; }
  [[nodiscard]] Duration monotonic() const override { return running_; }
  [[nodiscard]] Duration since_start() const { return running_ - kFirst; }
  void advance(Duration by) {
    utc_ = utc_ + by;
    running_ = running_ + by;
  }
  void set_wall_clock(Duration by) { utc_ = utc_ + by; }

 private:
  static constexpr Duration kFirst = Duration::seconds(5000);
  Time utc_ = kUtc;
  Duration running_ = kFirst;
};

/// A bus on which everything happens when the test said so; waiting on it is how time passes.
class FakeBus final : public VehicleBus {
 public:
  explicit FakeBus(FakeClock& clock) : clock_(clock) {}

  /// Once the loop waits for or beyond `at`.
  void then(Duration at, std::function<void(Time now, InputSink&)> what) { script_.push_back({at, std::move(what)}); }

  void wait(Duration most) override {
    const Duration now = clock_.since_start();
    Duration until = now + most;
    for (const Event& event : script_) {
      if (!event.over) until = std::min(until, std::max(now, event.at));
    }
    clock_.advance(until - now);
  }

  void collect(Time now, InputSink& sink) override {
    std::ranges::stable_sort(script_, {}, &Event::at);
    for (Event& event : script_) {
      if (event.over || event.at > clock_.since_start()) continue;
      event.over = true;
      event.what(now, sink);
    }
  }

  void publish(Time now, const runtime::Outputs& outputs) override {
    times.push_back(now);
    published.push_back(outputs);
    if (on_publish) on_publish();
    ++counters_.setpoint_messages;
  }

  [[nodiscard]] const runtime::Outputs& last() const { return published.back(); }

  std::vector<Time> times;
  std::vector<runtime::Outputs> published;
  std::function<void()> on_publish;

 private:
  struct Event {
    Duration at;
    std::function<void(Time, InputSink&)> what;
    bool over = false;
  };
  FakeClock& clock_;
  std::vector<Event> script_;
};

/// A vehicle that lies still in the middle of its area, its real runtime and journal, and everything else in the test's hand.
class AtSea : public testing::Test {
 protected:
  void SetUp() override {
    path_ = fs::path(testing::TempDir()) / (std::string("at-sea-") + std::to_string(::getpid()));
    ASSERT_EQ(runtime_->configure(runtime::paper_mission(), *runtime::policy_that_goes(runtime::kNorthward)), Status::kOk);
    journal_ = std::make_unique<Journal>(path_, JournalOptions{.existing = JournalOptions::Existing::kReplace});
  }
  void TearDown() override {
    (void)journal_->close();
    fs::remove(path_);
  }

  /// Its sender's wall clock is this host's.
  [[nodiscard]] runtime::Navigation fix() const {
    return {.time = clock_.utc(),
            .position = runtime::at(7000, 12000),
            .depth = Meters{300},
            .heading = Radians{0},
            .speed = MetersPerSecond{2}};
  }
  [[nodiscard]] runtime::SnrEstimate snr() const { return {.time = clock_.utc(), .snr = Decibels{12}}; }

  /// Navigation and SNR once a second from `from` to `to`, each a tenth before the turn.
  void hear(int from, int to) {
    for (int second = from; second < to; ++second) {
      bus_.then(seconds(second + 0.9), [this](Time now, InputSink& sink) {
        sink.take(now, fix());
        sink.take(now, snr());
      });
    }
  }
  void order(Duration at, OperatorCommand command) {
    bus_.then(at, [command](Time now, InputSink& sink) { sink.take(now, command); });
  }
  void stop_at(int second) {
    bus_.then(seconds(second), [this](Time, InputSink&) { stop_ = true; });
  }

  LoopResult fly() {
    MissionTurn turn(*runtime_, bus_, *journal_);
    return fly_at_sea(turn, bus_, clock_, kTiming, stop_);
  }

  std::vector<OperatorCommand> journalled_orders() {
    (void)journal_->close();
    JournalReader reader(path_);
    std::vector<OperatorCommand> orders;
    for (JournalRecord record; reader.next(record);) {
      operator_command_t command{};
      if (decode(record.data, command) == Status::kOk) orders.push_back(from_message(command));
    }
    return orders;
  }

  health_t last_journalled_health() {
    (void)journal_->close();
    JournalReader reader(path_);
    health_t health{};
    for (JournalRecord record; reader.next(record);) {
      if (record.channel != wire::kHealthChannel) continue;
      EXPECT_EQ(decode(record.data, health), Status::kOk);
    }
    return health;
  }

  fs::path path_;
  FakeClock clock_;
  FakeBus bus_{clock_};
  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  std::unique_ptr<Journal> journal_;
  std::atomic<bool> stop_{false};
};

TEST_F(AtSea, TurnsOnceAPeriodAndSearchesOnceStarted) {
  hear(0, 20);
  order(seconds(1.5), OperatorCommand::kStart);
  stop_at(20);
  (void)fly();
  ASSERT_GE(bus_.published.size(), 19U);
  EXPECT_EQ(bus_.published[0].state, MissionState::kStandby);
  for (std::size_t i = 1; i < 19; ++i) {
    EXPECT_EQ(bus_.published[i].state, MissionState::kSearch) << i;
    EXPECT_EQ(bus_.times[i] - bus_.times[i - 1], kPeriod) << i;
  }
}

TEST_F(AtSea, AnAbortHoldsThoughOtherOrdersFollowItInItsTurn) {
  hear(0, 5);
  using enum OperatorCommand;
  for (const OperatorCommand command : {kStart, kAbort, kStart, kComplete}) order(seconds(2.5), command);
  stop_at(5);
  (void)fly();
  EXPECT_EQ(bus_.last().state, MissionState::kAbort);
  EXPECT_EQ(bus_.last().end_reason, runtime::EndReason::kOperatorAbort);
  EXPECT_EQ(bus_.last().counters.commands_refused, 2U);
  EXPECT_EQ(journalled_orders(), (std::vector{kStart, kAbort, kStart, kComplete}));
}

TEST_F(AtSea, AGoodFixCountsThoughBadAndOlderOnesFollowItInItsTurn) {
  hear(0, 20);
  order(seconds(1.5), OperatorCommand::kStart);
  for (int second = 0; second < 20; ++second) {
    bus_.then(seconds(second + 0.95), [this](Time now, InputSink& sink) {
      runtime::Navigation bad = fix();
      bad.position.north = Meters{std::nan("")};
      sink.take(now, bad);
      runtime::Navigation older = fix();
      older.time = older.time + Duration::milliseconds(-500);
      older.position.north = Meters{-4000};
      sink.take(now, older);
      sink.take(now, runtime::SnrEstimate{.time = now, .snr = Decibels{std::numeric_limits<double>::infinity()}});
    });
  }
  stop_at(20);
  (void)fly();
  EXPECT_EQ(bus_.published[18].state, MissionState::kSearch);
  EXPECT_EQ(bus_.published[18].counters.navigation_refused, 2U * 19U);
  EXPECT_EQ(bus_.published[18].counters.snr_refused, 19U);
}

TEST_F(AtSea, ItsJournalGivesTheSameOutputsAgainBitForBit) {
  hear(0, 20);
  order(seconds(1.5), OperatorCommand::kStart);
  order(seconds(12.5), OperatorCommand::kAbort);
  order(seconds(12.5), OperatorCommand::kStart);
  stop_at(20);
  (void)fly();
  ASSERT_EQ(journal_->close(), Status::kOk);
  runtime::Runtime again;
  ASSERT_EQ(again.configure(runtime::paper_mission(), *runtime::policy_that_goes(runtime::kNorthward)), Status::kOk);
  JournalReader reader(path_);
  std::size_t turns = 0;
  for (JournalRecord record; reader.next(record);) {
    nav_state_t navigation{};
    snr_estimate_t estimate{};
    operator_command_t command{};
    if (decode(record.data, navigation) == Status::kOk) again.take(record.time, from_message(navigation));
    if (decode(record.data, estimate) == Status::kOk) again.take(record.time, from_message(estimate));
    if (decode(record.data, command) == Status::kOk) again.take(record.time, from_message(command));
    if (record.channel != wire::kSetpointChannel) continue;
    const Encoded setpoint(to_message(again.step(record.time).setpoint, record.time));
    ASSERT_TRUE(std::ranges::equal(record.data, setpoint.bytes())) << "turn " << turns;
    ++turns;
  }
  EXPECT_EQ(turns, bus_.published.size());
}

TEST_F(AtSea, AWallClockSetBackOrForthDisturbsNeitherTheSearchNorItsTime) {
  hear(0, 60);
  order(seconds(1.5), OperatorCommand::kStart);
  bus_.then(seconds(10.2), [this](Time, InputSink&) { clock_.set_wall_clock(Duration::seconds(-3600)); });
  bus_.then(seconds(35.2), [this](Time, InputSink&) { clock_.set_wall_clock(Duration::seconds(7200)); });
  stop_at(60);
  (void)fly();
  ASSERT_GE(bus_.published.size(), 59U);
  for (std::size_t i = 1; i < 59; ++i) {
    EXPECT_EQ(bus_.published[i].state, MissionState::kSearch) << i;
    EXPECT_EQ(bus_.times[i] - bus_.times[i - 1], kPeriod) << i;
  }
}

TEST_F(AtSea, ASenderThatRepeatsItsLastFixForEverIsStale) {
  hear(0, 10);
  order(seconds(1.5), OperatorCommand::kStart);
  const runtime::Navigation last = fix();  // dated with the beginning
  for (int second = 10; second < 30; ++second) {
    bus_.then(seconds(second + 0.9), [this, last](Time now, InputSink& sink) {
      runtime::Navigation repeated = last;
      repeated.time = last.time + seconds(9.9);
      sink.take(now, repeated);
      sink.take(now, snr());
    });
  }
  stop_at(30);
  (void)fly();
  // Its date is believed until it is 2.5 s old: at 10.9, 11.9 and no more; all others are refused, and health says so.
  EXPECT_EQ(last_journalled_health().bus_refused, 30 - 12);
  EXPECT_EQ(bus_.published[13].state, MissionState::kSearch);
  EXPECT_EQ(bus_.published[20].end_reason, runtime::EndReason::kNavigationStale);
}

TEST_F(AtSea, AStalledTurnIsFollowedByOneWithWhatArrivedMeanwhileAndNoneIsMadeUpFor) {
  hear(0, 40);
  order(seconds(1.5), OperatorCommand::kStart);
  bus_.on_publish = [this] {
    if (bus_.published.size() == 10) clock_.advance(seconds(20.5));
  };
  stop_at(40);
  (void)fly();
  for (std::size_t i = 1; i < bus_.published.size() - 1; ++i) EXPECT_EQ(bus_.published[i].state, MissionState::kSearch) << i;
  EXPECT_EQ(bus_.times[10] - bus_.times[9], seconds(20.5));
  for (std::size_t i = 11; i < bus_.times.size() - 1; ++i) EXPECT_EQ(bus_.times[i] - bus_.times[i - 1], kPeriod) << i;
}

TEST_F(AtSea, BeingStoppedInMidSearchEndsWithASetPointThatSaysStopAndComeUp) {
  hear(0, 20);
  order(seconds(1.5), OperatorCommand::kStart);
  stop_at(15);
  const LoopResult result = fly();
  EXPECT_EQ(result.end, LoopEnd::kStopped);
  EXPECT_EQ(result.time - result.began, Duration::seconds(15));
  ASSERT_GT(bus_.published.size(), 14U);
  EXPECT_EQ(bus_.published[13].setpoint.speed, MetersPerSecond{2});
  EXPECT_EQ(bus_.last().state, MissionState::kAbort);
  EXPECT_EQ(bus_.last().setpoint.speed, MetersPerSecond{0});
  EXPECT_EQ(bus_.last().setpoint.depth, Meters{0});
  EXPECT_EQ(journalled_orders().back(), OperatorCommand::kAbort);
}

TEST_F(AtSea, BeingStoppedAfterItsEndLeavesTheEndAsItWas) {
  hear(0, 20);
  order(seconds(1.5), OperatorCommand::kStart);
  order(seconds(5.5), OperatorCommand::kComplete);
  stop_at(15);
  EXPECT_EQ(fly().last.end_reason, runtime::EndReason::kCompleted);
  EXPECT_EQ(bus_.last().state, MissionState::kDone);
}

TEST_F(AtSea, WhatComesOutIsInTheJournalBeforeItIsOnTheBus) {
  std::vector<std::uint64_t> journalled;
  bus_.on_publish = [&] { journalled.push_back(journal_->counters().appended); };
  stop_at(3);
  (void)fly();
  ASSERT_GE(journalled.size(), 2U);
  EXPECT_EQ(journalled[0], 2U);  // set-point and health: nothing has come in
  EXPECT_EQ(journalled[1], 4U);
}

}  // namespace
}  // namespace earshot::board
