#include "firmware/boards/linux/mission_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/boards/linux/at_sea.hpp"

namespace earshot::board {
namespace {

using messages::EndReason;
using messages::MissionState;
using messages::Order;

constexpr std::size_t kStopTurns = 5;  ///< of a loop that was told to stop in a search

TEST_F(AtSea, TurnsOnceAPeriodAndSearchesOnceStarted) {
  hear(0, 20);
  order(seconds(1.5), Order::kStart);
  stop_at(20);
  (void)fly();
  ASSERT_GE(port_->published.size(), 19U);
  EXPECT_EQ(port_->health(0).state, MissionState::kStandby);
  EXPECT_FALSE(port_->published[0].setpoint) << "the autopilot is not ours yet";
  for (std::size_t i = 1; i < 19; ++i) {
    EXPECT_EQ(port_->health(i).state, MissionState::kSearch) << i;
    EXPECT_EQ(port_->times[i] - port_->times[i - 1], kPeriod) << i;
  }
}

TEST_F(AtSea, ServesItsPortsWheneverItWakesNotOnlyOnceATurn) {
  for (int tenth = 1; tenth < 50; ++tenth) script_.then(Duration::milliseconds(100 * tenth), [](Clock&, InputSink&) {});
  stop_at(5);
  (void)fly();
  EXPECT_GE(port_->served, 50U) << "45 times between turns, 5 with one";
  EXPECT_FALSE(port_->answered_late) << "what was read waits for the next wake";
  EXPECT_LT(port_->published.size(), 11U);
}

TEST_F(AtSea, AnAbortHoldsThoughOtherOrdersFollowItInItsTurn) {
  hear(0, 5);
  using enum Order;
  for (const Order command : {kStart, kAbort, kStart, kComplete}) order(seconds(2.5), command);
  stop_at(5);
  (void)fly();
  EXPECT_EQ(port_->last().state, MissionState::kAbort);
  EXPECT_EQ(port_->last().end_reason, EndReason::kOperatorAbort);
  EXPECT_EQ(port_->last().counters.commands_refused, 2U);
  EXPECT_EQ(journalled_orders(), (std::vector{kStart, kAbort, kStart, kComplete}));
}

TEST_F(AtSea, AGoodFixCountsThoughBadAndOlderOnesFollowItInItsTurn) {
  hear(0, 20);
  order(seconds(1.5), Order::kStart);
  for (int second = 0; second < 20; ++second) {
    script_.then(seconds(second + 0.95), [this](Clock& clock, InputSink& sink) {
      messages::Navigation bad = fix();
      bad.position.north = Meters{std::nan("")};
      send(clock, sink, bad);
      messages::Navigation older = fix();
      older.time = older.time + Duration::milliseconds(-500);
      older.position.north = older.position.north - Meters{10};
      send(clock, sink, older);
      send(clock, sink, messages::SnrMeasurement{.time = host_.utc(), .snr = Decibels{std::numeric_limits<double>::infinity()}});
    });
  }
  stop_at(20);
  (void)fly();
  EXPECT_EQ(port_->health(18).state, MissionState::kSearch);
  EXPECT_EQ(port_->health(18).counters.navigation_refused, 2U * 19U);
  EXPECT_EQ(port_->health(18).counters.snr_refused, 19U);
}

TEST_F(AtSea, ItsJournalGivesTheSameOutputsAgainBitForBit) {
  hear(0, 20);
  order(seconds(1.5), Order::kStart);
  order(seconds(12.5), Order::kAbort);
  order(seconds(12.5), Order::kStart);
  stop_at(20);
  (void)fly();
  ASSERT_EQ(journal_->close(), Status::kOk);
  expect_journal_repeats();
}

TEST_F(AtSea, AWallClockSetBackOrForthDisturbsNeitherTheSearchNorItsTime) {
  hear(0, 60);
  order(seconds(1.5), Order::kStart);
  script_.then(seconds(10.2), [this](Clock&, InputSink&) { host_.set_wall_clock(Duration::seconds(-3600)); });
  script_.then(seconds(35.2), [this](Clock&, InputSink&) { host_.set_wall_clock(Duration::seconds(7200)); });
  stop_at(60);
  (void)fly();
  ASSERT_GE(port_->published.size(), 59U);
  for (std::size_t i = 1; i < 59; ++i) {
    EXPECT_EQ(port_->health(i).state, MissionState::kSearch) << i;
    EXPECT_EQ(port_->times[i] - port_->times[i - 1], kPeriod) << i;
  }
}

TEST_F(AtSea, ASenderThatRepeatsItsLastFixForEverIsStale) {
  hear(0, 10);
  order(seconds(1.5), Order::kStart);
  const messages::Navigation last = fix();  // dated with the beginning
  for (int second = 10; second < 30; ++second) {
    script_.then(seconds(second + 0.9), [this, last](Clock& clock, InputSink& sink) {
      messages::Navigation repeated = last;
      repeated.time = last.time + seconds(9.9);
      send(clock, sink, repeated);
      send(clock, sink, snr());
    });
  }
  stop_at(30);
  (void)fly();
  // Its date is 9.9 s, and it is refused from 14.9 s on, but for that one: 5 s are allowed.
  EXPECT_EQ(port_->last().counters.navigation_refused, 30U - 15U);
  EXPECT_EQ(port_->health(13).state, MissionState::kSearch);
  EXPECT_EQ(port_->health(20).end_reason, EndReason::kNavigationStale);
}

TEST_F(AtSea, AStalledTurnIsFollowedByOneWithWhatArrivedMeanwhileAndNoneIsMadeUpFor) {
  hear(0, 40);
  order(seconds(1.5), Order::kStart);
  port_->on_publish = [this] {
    if (port_->published.size() == 10) host_.advance(seconds(20.5));
  };
  stop_at(40);
  (void)fly();
  for (std::size_t i = 1; i < port_->published.size() - kStopTurns; ++i) EXPECT_EQ(port_->health(i).state, MissionState::kSearch) << i;
  EXPECT_EQ(port_->times[10] - port_->times[9], seconds(20.5));
  for (std::size_t i = 11; i < port_->times.size() - kStopTurns; ++i) EXPECT_EQ(port_->times[i] - port_->times[i - 1], kPeriod) << i;
}

TEST_F(AtSea, BeingStoppedInMidSearchEndsWithASetPointThatSaysStopAndComeUp) {
  hear(0, 20);
  order(seconds(1.5), Order::kStart);
  stop_at(15);
  const LoopResult result = fly();
  EXPECT_EQ(result.end, LoopEnd::kStopped);
  EXPECT_EQ(result.found_in, MissionState::kSearch);
  // START comes after the first turn.
  EXPECT_EQ(result.turns_in, (std::array<std::uint64_t, 4>{1, 14, 0, 5}));
  // At once and then once a period: at 15, 16, 17, 18 and 19 s.
  EXPECT_EQ(result.time - result.began, Duration::seconds(19));
  ASSERT_EQ(port_->published.size(), 15U + 5U);
  EXPECT_EQ(port_->published[13].setpoint->speed, MetersPerSecond{2});
  for (std::size_t i = 15; i < 20; ++i) {
    EXPECT_EQ(port_->published[i].setpoint->speed, MetersPerSecond{0}) << i;
    EXPECT_EQ(port_->times[i], result.began + Duration::seconds(static_cast<std::int64_t>(i))) << i;
  }
  EXPECT_EQ(port_->last().state, MissionState::kAbort);
  EXPECT_EQ(port_->published.back().setpoint->speed, MetersPerSecond{0});
  EXPECT_EQ(port_->published.back().setpoint->depth, Meters{0});
  EXPECT_EQ(journalled_orders().back(), Order::kAbort);
}

/// Time goes on between a stop and the turn that answers it, as in lock-step between two ticks.
class ClockThatTicksLate final : public Clock {
 public:
  ClockThatTicksLate(FakeClock& clock, FakeHost& host, const std::atomic<bool>& stop) : clock_(clock), host_(host), stop_(stop) {}
  [[nodiscard]] Time now() override { return clock_.now(); }
  [[nodiscard]] Time mission_time_of(Time utc) override { return clock_.mission_time_of(utc); }
  [[nodiscard]] Time arrival_of(Time utc) override { return clock_.arrival_of(utc); }
  [[nodiscard]] bool answered(const runtime::Outputs& outputs, std::uint64_t sent) override { return clock_.answered(outputs, sent); }
  [[nodiscard]] Wake wait(const Awaited& awaited) override {
    if (!stop_ || std::exchange(is_late_, true)) return clock_.wait(awaited);
    host_.advance(seconds(0.4));
    return Wake::kNothing;
  }

 private:
  FakeClock& clock_;
  FakeHost& host_;
  const std::atomic<bool>& stop_;
  bool is_late_ = false;
};

TEST_F(AtSea, BeingStoppedItDatesItsAbortWithTheTurnThatTakesIt) {
  hear(0, 20);
  order(seconds(1.5), Order::kStart);
  stop_at(15);
  ClockThatTicksLate clock(clock_, host_, stop_);
  const LoopResult result = fly(clock);
  EXPECT_EQ(port_->times[15] - result.began, seconds(15.4));
  ASSERT_EQ(port_->published[15].acknowledgements.size(), 1U);
  EXPECT_EQ(port_->published[15].acknowledgements.begin()->time, port_->times[15]);
  EXPECT_EQ(port_->published[15].health.state, MissionState::kAbort);
}

TEST_F(AtSea, BeingStoppedBeforeASearchBeganCommandsNothing) {
  hear(0, 5);
  stop_at(3);
  (void)fly();
  for (const runtime::Outputs& outputs : port_->published) EXPECT_FALSE(outputs.setpoint);
  EXPECT_EQ(port_->last().state, MissionState::kAbort);
}

TEST_F(AtSea, BeingStoppedAfterItsEndLeavesTheEndAsItWas) {
  hear(0, 20);
  order(seconds(1.5), Order::kStart);
  order(seconds(5.5), Order::kComplete);
  stop_at(15);
  EXPECT_EQ(fly().last.health.end_reason, EndReason::kCompleted);
  EXPECT_EQ(port_->last().state, MissionState::kDone);
}

/// A mission that another process began and that this one goes on with, on the same runtime.
class GoneOnWithAtSea : public AtSea {
 protected:
  /// @param orders  which the process before obeyed in its only turn
  LoopResult stop_before_the_first_turn(std::initializer_list<Order> orders) {
    OwnCore core(*runtime_);
    MissionTurn before(core, ports_, *journal_, clock_);
    host_.advance(kPeriod);
    send(clock_, before, fix());
    send(clock_, before, snr());
    for (const Order order : orders) before.take(kPort, runtime::command_of(order, clock_.now(), ++commands_));
    const runtime::Outputs last = before();
    MissionTurn turn(core, ports_, *journal_, clock_);
    Resumption resumption;
    resumption.memory.last = before.last();
    resumption.last = last;
    turn.go_on_after(resumption, "of a test");
    stop_at(4);
    return board::fly(turn, ports_, clock_, {.period = kPeriod}, stop_, {.most = Duration::seconds(5)});
  }
};

TEST_F(GoneOnWithAtSea, BeingStoppedWhileItWaitsForItsSensorsItWasFoundInTheSearchOfTheProcessBefore) {
  const LoopResult result = stop_before_the_first_turn({Order::kStart});
  EXPECT_EQ(result.found_in, MissionState::kSearch);
  EXPECT_EQ(result.turns, kStopTurns);
  EXPECT_EQ(result.last.health.state, MissionState::kAbort);
}

TEST_F(GoneOnWithAtSea, BeingStoppedWhileItWaitsForItsSensorsAnAbortOfTheProcessBeforeStaysTheOnlyOne) {
  EXPECT_EQ(stop_before_the_first_turn({Order::kStart, Order::kAbort}).found_in, MissionState::kAbort);
  EXPECT_EQ(journalled_orders(), (std::vector{Order::kStart, Order::kAbort}));
}

TEST_F(AtSea, WhatComesOutIsInTheJournalBeforeItIsOnTheBus) {
  std::vector<std::uint64_t> journalled;
  port_->on_publish = [&] { journalled.push_back(journal_->counters().appended); };
  stop_at(3);
  (void)fly();
  ASSERT_GE(journalled.size(), 2U);
  EXPECT_EQ(journalled[0], 2U);  // the port's first report and health: nothing has come in, and STANDBY commands nothing
  EXPECT_EQ(journalled[1], 3U);
}

}  // namespace
}  // namespace earshot::board
