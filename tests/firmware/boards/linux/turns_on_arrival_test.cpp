// A loop in which arrivals make turns (a mission's turns = "on_arrival"): when it turns, and when it does not.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/boards/linux/mission_loop.hpp"
#include "tests/firmware/boards/linux/at_sea.hpp"

namespace earshot::board {
namespace {

using messages::MissionState;
using messages::Order;

class OnArrival : public AtSea {
 protected:
  OnArrival() { turns_ = host::Turns::kOnArrival; }

  void bring_fix(double at) {
    script_.then(seconds(at), [this](Clock& clock, InputSink& sink) { send(clock, sink, fix()); });
  }
  void bring_snr(double at) {
    script_.then(seconds(at), [this](Clock& clock, InputSink& sink) { send(clock, sink, snr()); });
  }
  /// In microseconds since the loop began.
  [[nodiscard]] std::vector<std::int64_t> turns_at() const {
    std::vector<std::int64_t> all;
    for (const Time time : port_->times) all.push_back((time - kUtc).us);
    return all;
  }
};

TEST_F(OnArrival, AFixMakesATurnAtOnceAndSilenceAPeriodLater) {
  for (const double at : {0.3, 0.45, 2.0}) bring_fix(at);
  stop_at(3);
  (void)fly();
  const std::vector<std::int64_t> expected{300'000, 450'000, 1'450'000, 2'000'000, 3'000'000};
  ASSERT_GE(turns_at().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(turns_at()[i], expected[i]) << i;
}

TEST_F(OnArrival, AnOrderIsAnsweredAtOnceThoughNoFixComes) {
  order(seconds(0.25), Order::kAbort);
  stop_at(1);
  (void)fly();
  EXPECT_EQ(turns_at().at(0), 250'000);
  EXPECT_EQ(port_->published[0].acknowledgements.size(), 1U);
  EXPECT_EQ(port_->health(0).state, MissionState::kAbort);
}

TEST_F(OnArrival, AnSnrWaitsForTheNextTurn) {
  bring_snr(0.25);
  stop_at(2);
  (void)fly();
  EXPECT_EQ(turns_at().at(0), 1'000'000);
}

TEST_F(OnArrival, AFloodMakesNoMoreTurnsThanItMayAndItsLastFixIsServedByTheNext) {
  // A fix every 100 us for 20 ms; between two turns there are 2 ms.
  for (int i = 0; i < 200; ++i) bring_fix(0.5 + 1e-4 * i);
  stop_at(1);
  (void)fly();
  for (std::size_t i = 0; i <= 10; ++i) EXPECT_EQ(turns_at().at(i), 500'000 + 2000 * static_cast<std::int64_t>(i)) << i;
  EXPECT_EQ(turns_at().at(11), 1'000'000) << "the stop: the fix of 519.9 ms was served at 520 ms";
}

TEST_F(OnArrival, ItsSetpointFollowsEveryFixOfASearch) {
  bring_snr(0.1);
  order(seconds(0.2), Order::kStart);
  for (int i = 0; i < 30; ++i) bring_fix(0.3 + 0.1 * i);
  stop_at(3);
  (void)fly();
  EXPECT_EQ(port_->health(0).state, MissionState::kStandby) << "the START, before the first fix";
  for (std::size_t i = 1; i <= 27; ++i) {
    EXPECT_EQ(turns_at().at(i), 200'000 + 100'000 * static_cast<std::int64_t>(i)) << i;
    EXPECT_EQ(port_->health(i).state, MissionState::kSearch) << i;
    EXPECT_TRUE(port_->published[i].setpoint) << i;
  }
}

TEST_F(OnArrival, AStopSaysFiveTimesThatTheVehicleComesUpEachAPeriodAfterTheOther) {
  bring_snr(0.1);
  order(seconds(0.2), Order::kStart);
  order(seconds(1.05), Order::kAbort);
  for (int i = 0; i < 100; ++i) bring_fix(0.3 + 0.1 * i);
  stop_at(2);
  const LoopResult result = fly();
  EXPECT_EQ(result.time - result.began, Duration::seconds(6)) << "turns of arrivals follow too closely to count";
  EXPECT_EQ(result.found_in, MissionState::kAbort);
}

TEST_F(OnArrival, ItsJournalGivesTheSameOutputsAgainBitForBit) {
  bring_snr(0.1);
  order(seconds(0.2), Order::kStart);
  for (int i = 0; i < 200; ++i) bring_fix(0.3 + 0.0007 * i);
  stop_at(3);
  (void)fly();
  ASSERT_EQ(journal_->close(), Status::kOk);
  expect_journal_repeats();
}

}  // namespace
}  // namespace earshot::board
