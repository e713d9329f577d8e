// What reaches a decision, and when: the SNR of its own turn, fixes late and missing, orders of a bus in simulation.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "firmware/boards/linux/mission_loop.hpp"
#include "tests/firmware/boards/linux/at_sea.hpp"

namespace earshot::board {
namespace {

using messages::CommandOutcome;
using messages::EndReason;
using messages::MissionState;
using messages::Order;

/// The turn that is made so many seconds after the loop began.
std::size_t at_second(int second) {
  return static_cast<std::size_t>(second) - 1;
}

class TheLoop : public AtSea {
 protected:
  /// An SNR, or a fix, that is dated when it comes.
  void bring(double at, Decibels snr, bool too_faint = false) {
    script_.then(seconds(at), [this, snr, too_faint](Clock& clock, InputSink& sink) {
      send(clock, sink, messages::SnrMeasurement{.time = host_.utc(), .snr = snr, .too_faint = too_faint});
    });
  }
  void bring_fix(double at, NorthEast position) {
    script_.then(seconds(at), [this, position](Clock& clock, InputSink& sink) {
      messages::Navigation navigation = fix();
      navigation.position = position;
      send(clock, sink, navigation);
    });
  }
  /// A fix of `measured` seconds that comes at `arrives`.
  void bring_late_fix(double measured, double arrives) {
    script_.then(seconds(arrives), [this, measured](Clock& clock, InputSink& sink) {
      messages::Navigation navigation = fix();
      navigation.time = kUtc + seconds(measured);
      send(clock, sink, navigation);
    });
  }
  void hear_snr(int from, int to) {
    for (int second = from; second < to; ++second) bring(second + 0.9, Decibels{12});
  }
  void hear_fixes(int from, int to) {
    for (int second = from; second < to; ++second) bring_late_fix(second + 0.9, second + 0.9);
  }
  [[nodiscard]] const messages::Decision& decision_at(int second) {
    const auto& decision = port_->published.at(at_second(second)).decision;
    EXPECT_TRUE(decision) << second;
    static const messages::Decision none;
    return decision ? *decision : none;
  }

  const NorthEast start_ = at(7000, 12000);
  const NorthEast after_one_step_ = at(8000, 12000);
};

TEST_F(TheLoop, DecidesByTheSnrOfItsOwnTurnAndOfNoOther) {
  for (int second = 0; second < 10; ++second) {
    bring_fix(second + 0.9, second < 6 ? start_ : after_one_step_);
    bring(second + 0.9, Decibels{10.0 + second});
  }
  order(seconds(1.5), Order::kStart);
  stop_at(10);
  (void)fly();
  EXPECT_EQ(decision_at(2).snr, Decibels{11}) << "heard at 1.9 s";
  EXPECT_EQ(decision_at(7).snr, Decibels{16}) << "heard at 6.9 s, where the step ended";
  EXPECT_EQ(decision_at(7).step, 1U);
  for (const int second : {1, 3, 4, 5, 6, 8, 9}) EXPECT_FALSE(port_->published[at_second(second)].decision) << second;
}

TEST_F(TheLoop, TakesNoFloorForAMeasurementHoweverHighItIs) {
  for (int second = 0; second < 10; ++second) {
    bring_fix(second + 0.9, second < 6 ? start_ : after_one_step_);
    bring(second + 0.9, Decibels{22}, second < 6);
  }
  order(seconds(1.5), Order::kStart);
  stop_at(10);
  (void)fly();
  EXPECT_TRUE(decision_at(2).too_faint);
  EXPECT_FALSE(decision_at(2).detected) << "somewhere below 22 dB, and 10 dB are detected";
  EXPECT_FALSE(decision_at(7).too_faint);
  EXPECT_TRUE(decision_at(7).detected);
}

TEST_F(TheLoop, TakesFixesThatComeLateByTheDateThatTheyBear) {
  hear_snr(0, 30);
  for (int second = 0; second <= 10; ++second) bring_late_fix(second + 0.9, second + 3.9);
  order(seconds(1.5), Order::kStart);
  stop_at(30);
  (void)fly();
  EXPECT_EQ(port_->last().counters.navigation_refused, 0U);
  EXPECT_EQ(port_->health(at_second(4)).state, MissionState::kSearch);
  // The last is of 10.9 s, and 5 s are allowed; by its arrival it would do until 18.9 s.
  EXPECT_EQ(port_->health(at_second(15)).state, MissionState::kSearch);
  EXPECT_EQ(port_->health(at_second(16)).end_reason, EndReason::kNavigationStale);
}

TEST_F(TheLoop, RefusesAndCountsEveryFixThatComesLaterThanFixesMay) {
  hear_snr(0, 20);
  for (int second = 0; second < 10; ++second) bring_late_fix(second + 0.9, second + 6.0);
  order(seconds(1.5), Order::kStart);
  stop_at(20);
  (void)fly();
  EXPECT_EQ(port_->health(at_second(19)).state, MissionState::kStandby);
  EXPECT_EQ(port_->health(at_second(19)).counters.navigation_refused, 10U) << "5.1 s late each";
}

TEST_F(TheLoop, GoesOnWhileFixesAreMissingForAsLongAsTheyMayAndNoLonger) {
  hear_snr(0, 30);
  hear_fixes(0, 11);
  hear_fixes(15, 16);
  hear_fixes(21, 30);
  order(seconds(1.5), Order::kStart);
  stop_at(30);
  (void)fly();
  for (int second = 2; second <= 20; ++second) EXPECT_EQ(port_->health(at_second(second)).state, MissionState::kSearch) << second;
  EXPECT_EQ(port_->health(at_second(21)).end_reason, EndReason::kNavigationStale) << "the last was 5.1 s ago, and the next is late";
  EXPECT_EQ(port_->health(at_second(29)).state, MissionState::kAbort);
}

TEST_F(TheLoop, GoesOnWhileMeasurementsAreMissingForAsLongAsTheyMayAndNoLonger) {
  hear_fixes(0, 50);
  hear_snr(0, 11);
  order(seconds(1.5), Order::kStart);
  stop_at(50);
  (void)fly();
  EXPECT_EQ(port_->health(at_second(40)).state, MissionState::kSearch) << "29.1 s";
  EXPECT_EQ(port_->health(at_second(41)).end_reason, EndReason::kSnrStale) << "30.1 s";
}

TEST_F(TheLoop, TakesOfTwoEstimatesOfOneDateTheOneThatComesLast) {
  const NorthEast better = at(7010, 12020);
  for (int second = 0; second < 5; ++second) {
    bring_fix(second + 0.9, start_);
    bring_fix(second + 0.9, better);
    bring(second + 0.9, Decibels{12});
    bring(second + 0.9, Decibels{15});
  }
  order(seconds(1.5), Order::kStart);
  stop_at(5);
  (void)fly();
  EXPECT_EQ(decision_at(2).position, better);
  EXPECT_EQ(decision_at(2).snr, Decibels{15});
  EXPECT_EQ(port_->last().counters.navigation_refused, 0U);
  EXPECT_EQ(port_->last().counters.snr_refused, 0U);
}

TEST_F(TheLoop, CountsWhatItRefusesByItsKind) {
  hear(0, 10);
  order(seconds(1.5), Order::kStart);
  script_.then(seconds(3.95), [this](Clock& clock, InputSink& sink) {
    messages::Navigation nowhere = fix();
    nowhere.position.east = Meters{std::numeric_limits<double>::quiet_NaN()};
    send(clock, sink, nowhere);
    for (int i = 0; i < 2; ++i) send(clock, sink, messages::SnrMeasurement{.time = host_.utc(), .snr = Decibels{601}});
    const messages::Bearing bearing{.direction = Radians{1}, .deviation = Radians{0.2}};
    send(clock, sink, messages::BearingMeasurement{.time = host_.utc(), .bearing = {}});
    for (const std::uint32_t sender : {1U, 2U, 2U}) send(clock, sink, messages::BearingMeasurement{host_.utc(), bearing, sender});
  });
  for (int i = 0; i < 3; ++i) order(seconds(3.96), Order::kStart);
  stop_at(10);
  (void)fly();
  EXPECT_EQ(port_->health(at_second(3)).counters, messages::Counters{});
  EXPECT_EQ(port_->health(at_second(4)).counters,
            (messages::Counters{
                .navigation_refused = 1, .snr_refused = 2, .commands_refused = 3, .bearings_refused = 1, .bearings_of_others = 2}));
  EXPECT_EQ(port_->health(at_second(9)).counters, port_->health(at_second(4)).counters);
}

TEST_F(TheLoop, CountsEveryWaypointThatItsSafetyLayerMoves) {
  for (int second = 0; second < 5; ++second) {
    bring_fix(second + 0.9, at(18'900, 12'000));  // a step to the north ends 100 m short of the edge, where 500 m are to be kept
    bring(second + 0.9, Decibels{12});
  }
  order(seconds(1.5), Order::kStart);
  stop_at(5);
  (void)fly();
  EXPECT_TRUE(decision_at(2).overridden);
  EXPECT_EQ(decision_at(2).waypoint, at(19'500, 12'000));
  EXPECT_EQ(port_->health(at_second(4)).counters.setpoints_limited, 1U);
}

TEST_F(TheLoop, TellsWithItsHealthWhatEveryPortCountedUntilThen) {
  const messages::PortReport report{.port = kPort, .link_up = false, .received = 7, .lost = 2, .malformed = 3, .unsent = 4};
  script_.then(seconds(2.5), [&](Clock&, InputSink&) { port_->set_report(report); });
  stop_at(5);
  (void)fly();
  ASSERT_EQ(port_->health(at_second(2)).ports.size(), 1U);
  EXPECT_EQ(port_->health(at_second(2)).ports[0], messages::PortReport{.port = kPort});
  ASSERT_EQ(port_->health(at_second(3)).ports.size(), 1U);
  EXPECT_EQ(port_->health(at_second(3)).ports[0], report);
}

/// A simulator's clock: it stands still between ticks of a second, a turn is due once the fix of its tick is there, and what bears another
/// date than the tick's is of another flight.
class TickClock final : public Clock {
 public:
  TickClock(FakeHost& host, std::uint64_t ticks) : host_(host), ticks_(ticks) {}

  [[nodiscard]] Time now() override { return time_; }
  [[nodiscard]] Time mission_time_of(Time utc) override { return utc == time_ ? utc : Time{-1}; }
  [[nodiscard]] Time arrival_of(Time /*utc*/) override { return time_; }
  [[nodiscard]] bool answered(const runtime::Outputs& outputs, std::uint64_t /*sent*/) override {
    ++answers;
    return outputs.health.state != MissionState::kDone && outputs.health.state != MissionState::kAbort;
  }
  [[nodiscard]] Wake wait(const Awaited& awaited) override {
    if (is_there_) {
      if (awaited.navigation_taken < tick_) return Wake::kPorts;
      is_there_ = false;
      return Wake::kTurn;
    }
    if (tick_ == ticks_) return Wake::kLost;
    if (host_.since_start() < seconds(static_cast<double>(tick_ + 1))) {
      host_.advance(seconds(0.5));
      return Wake::kNothing;
    }
    ++tick_;
    time_ = host_.utc();
    is_there_ = true;
    return Wake::kPorts;
  }

  std::uint64_t answers = 0;

 private:
  FakeHost& host_;
  std::uint64_t ticks_;  ///< then the simulator is gone
  std::uint64_t tick_ = 0;
  bool is_there_ = false;
  Time time_ = kUtc;
};

class InSimulation : public TheLoop {
 protected:
  /// Fixes and measurements with every tick.
  void simulate(int ticks) {
    for (int second = 1; second <= ticks; ++second) {
      bring_fix(second, start_);
      bring(second, Decibels{12});
    }
  }
  /// Comes over the port at `at`, and says that it was given at `dated`.
  void order_over_bus(double at, double dated, Order order, std::uint32_t number) {
    script_.then(seconds(at), [dated, order, number](Clock& clock, InputSink& sink) {
      const Time date = clock.mission_time_of(kUtc + seconds(dated));
      sink.take(kPort, messages::OperatorCommand{.time = date, .expiry = date, .issuer = 1, .number = number, .order = order});
    });
  }
  [[nodiscard]] std::vector<CommandOutcome> outcomes() const {
    std::vector<CommandOutcome> all;
    for (const runtime::Outputs& outputs : port_->published) {
      for (const auto& acknowledgement : outputs.acknowledgements) {
        EXPECT_EQ(acknowledgement.port, kPort);
        all.push_back(acknowledgement.outcome);
      }
    }
    return all;
  }
};

TEST_F(InSimulation, ObeysAnOrderOfTheBusThatIsDatedWithTheTickThatItIsReadWith) {
  simulate(6);
  order_over_bus(2, 2, Order::kStart, 1);
  order_over_bus(4, 4, Order::kComplete, 2);
  TickClock clock(host_, 6);
  const LoopResult result = fly(clock);
  EXPECT_EQ(result.end, LoopEnd::kMissionOver);
  EXPECT_EQ(result.last.health.end_reason, EndReason::kCompleted);
  EXPECT_EQ(outcomes(), (std::vector{CommandOutcome::kObeyed, CommandOutcome::kObeyed}));
  EXPECT_EQ(port_->health(0).state, MissionState::kStandby);
  EXPECT_EQ(port_->health(1).state, MissionState::kSearch);
  EXPECT_EQ(clock.answers, 4U) << "no turn after the one that ended it";
}

TEST_F(InSimulation, RefusesAnOrderOfAnotherFlightButNoAbort) {
  simulate(6);
  order_over_bus(2, 1, Order::kStart, 1);
  order_over_bus(3, 3.5, Order::kStart, 2);
  order_over_bus(5, 1, Order::kAbort, 3);
  TickClock clock(host_, 6);
  const LoopResult result = fly(clock);
  EXPECT_EQ(outcomes(), (std::vector{CommandOutcome::kTooOld, CommandOutcome::kTooOld, CommandOutcome::kObeyed}));
  EXPECT_EQ(port_->health(3).state, MissionState::kStandby);
  EXPECT_EQ(result.last.health.end_reason, EndReason::kOperatorAbort);
}

TEST_F(InSimulation, ReadsNothingBeforeTheTickThatItBelongsToIsHere) {
  simulate(3);
  order_over_bus(1.5, 2, Order::kStart, 1);  // on the bus half a second before its tick
  TickClock clock(host_, 3);
  (void)fly(clock);
  EXPECT_EQ(outcomes(), (std::vector{CommandOutcome::kObeyed}));
  EXPECT_EQ(port_->health(1).state, MissionState::kSearch);
}

TEST_F(InSimulation, EndsWithoutAnotherTurnWhenItsSimulatorIsGone) {
  simulate(3);
  order_over_bus(2, 2, Order::kStart, 1);
  TickClock clock(host_, 3);
  const LoopResult result = fly(clock);
  EXPECT_EQ(result.end, LoopEnd::kClockLost);
  EXPECT_EQ(result.last.health.state, MissionState::kSearch);
  EXPECT_EQ(clock.answers, 3U);
}

}  // namespace
}  // namespace earshot::board
