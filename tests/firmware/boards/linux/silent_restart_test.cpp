// A mission that goes on from its journal while its sensors are silent: somebody commands, and an ABORT or a leak waits for nothing.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>

#include "firmware/boards/linux/outage/meanwhile.hpp"
#include "tests/firmware/boards/linux/at_sea.hpp"

namespace earshot::board {
namespace {

using messages::EndReason;
using messages::MissionState;
using messages::Order;

/// A search that another process began, and that this one goes on with, on the same runtime.
class SilentRestart : public AtSea {
 protected:
  static constexpr int kHold_s = 100;
  static constexpr int kSilence_s = 5;  ///< of the program

  void SetUp() override {
    AtSea::SetUp();
    host::SafetyRecord record;
    record.turn = 1;
    record.state = MissionState::kSearch;
    record.is_engaged = true;
    record.deepest = Meters{300};
    record.ascent_speed = MetersPerSecond{0.5};
    safety_.emplace(copies_, host_, record);
  }

  /// @param before  an order that came behind the last turn of the process before
  LoopResult fly_on(std::optional<Order> before = std::nullopt) {
    OwnCore core(*runtime_);
    MissionTurn first(core, ports_, *journal_, clock_);
    host_.advance(kPeriod);
    send(clock_, first, fix());
    send(clock_, first, snr());
    first.take(kPort, runtime::command_of(Order::kStart, clock_.now(), ++commands_));
    Resumption resumption;
    resumption.last = first();
    resumption.memory.last = first.last();
    if (before) {
      const messages::Input late{
          .arrival = clock_.now(), .port = kPort, .sequence = 3, .value = runtime::command_of(*before, clock_.now(), ++commands_)};
      (void)core.take(late);
      resumption.memory.note(late);
    }
    published_before_ = port_->published.size();
    MissionTurn turn(core, ports_, *journal_, clock_);
    turn.go_on_after(resumption, "of a test");
    Meanwhile meanwhile(mission(), ports_, clock_, *safety_);
    meanwhile.pass_on_to(turn);
    stop_at(kStop_s);
    return board::fly(turn, ports_, clock_, {.period = kPeriod}, stop_,
                      {.most = seconds(kHold_s), .meanwhile = &meanwhile, .meanwhile_from = clock_.now() + seconds(kSilence_s)});
  }
  /// The first that is told after the restart.
  [[nodiscard]] std::size_t first() const { return published_before_; }
  [[nodiscard]] Duration since_restart(std::size_t told) const { return port_->times.at(told) - port_->times.at(first() - 1); }
  [[nodiscard]] bool orders_abort_by(Duration by) const {
    for (std::size_t i = first(); i < port_->published.size() && since_restart(i) <= by; ++i)
      if (port_->health(i).end_reason == EndReason::kOperatorAbort) return true;
    return false;
  }

  static constexpr int kStop_s = 30;
  host::SafetyCopies copies_{{{.file = folder_ / "record"}}};
  std::optional<SafetyLog> safety_;
  std::size_t published_before_ = 0;
};

TEST_F(SilentRestart, TellsStopAndComeUpWithinSecondsThoughNoSensorSpeaks) {
  const LoopResult result = fly_on();
  ASSERT_GT(port_->published.size(), first());
  EXPECT_LE(since_restart(first()), seconds(kSilence_s + 1));
  const runtime::Outputs& told = port_->published.at(first());
  ASSERT_TRUE(told.setpoint);
  EXPECT_EQ(told.setpoint->depth, Meters{0});
  EXPECT_EQ(told.setpoint->speed, MetersPerSecond{0.5});
  EXPECT_EQ(told.health.state, MissionState::kSearch) << "it is not ended";
  for (std::size_t i = first() + 1; since_restart(i) < seconds(kStop_s - 1); ++i)
    EXPECT_EQ(port_->times[i] - port_->times[i - 1], kPeriod) << i;
  EXPECT_EQ(result.found_in, MissionState::kSearch);
}

TEST_F(SilentRestart, AnAbortEndsTheWaitAtOnce) {
  order(seconds(8.5), Order::kAbort);
  (void)fly_on();
  EXPECT_TRUE(orders_abort_by(seconds(10)));
}

TEST_F(SilentRestart, AnAbortThatTheProcessBeforeHadHeardIsNotWaitedWith) {
  (void)fly_on(Order::kAbort);
  EXPECT_TRUE(orders_abort_by(seconds(2)));
}

TEST_F(SilentRestart, ALeakEndsTheWaitAtOnce) {
  script_.then(seconds(8.5), [this](Clock& clock, InputSink& sink) {
    send(clock, sink, messages::VehicleStatus{.time = host_.utc(), .has_leak = true});
  });
  const LoopResult result = fly_on();
  EXPECT_GT(result.turns, 15U) << "from then on the mission makes its turns";
}

TEST_F(SilentRestart, GoesOnWithTheSearchOnceItsSensorsSpeak) {
  hear(12, kStop_s);
  const LoopResult result = fly_on();
  EXPECT_EQ(result.found_in, MissionState::kSearch);
  EXPECT_GT(result.turns, 10U);
  EXPECT_TRUE(std::ranges::any_of(port_->published,
                                  [](const runtime::Outputs& told) { return told.setpoint && told.setpoint->depth == Meters{300}; }));
}

/// It hung meanwhile, and the other took the vehicle for left alone.
TEST_F(SilentRestart, SaysNothingMoreToTheVehicleOnceAnotherProcessHasTheRecord) {
  copies_.prepare({});
  hear(0, kStop_s);
  order(seconds(1.5), Order::kStart);
  script_.then(seconds(5.2), [this](Clock&, InputSink&) {
    host::SafetyCopies others({{.file = folder_ / "record"}}, {}, host::Claim::kWaived);
    EXPECT_TRUE(others.write(others.found().value(), std::chrono::seconds(10)));
  });
  order(seconds(6.5), Order::kPause);
  stop_at(kStop_s);
  OwnCore core(*runtime_);
  MissionTurn turn(core, ports_, *journal_, clock_);
  turn.write_ahead(std::chrono::seconds(10));
  turn.keep_safe(*safety_);
  const LoopResult result = board::fly(turn, ports_, clock_, {.period = kPeriod}, stop_);
  EXPECT_EQ(result.end, LoopEnd::kOvertaken);
  EXPECT_EQ(port_->published.size(), 6U);
  EXPECT_FALSE(port_->last().is_paused);
}

}  // namespace
}  // namespace earshot::board
