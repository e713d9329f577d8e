#include "sim/link/lock_step_clock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <variant>
#include <vector>

#include "sim/link/run_slot.hpp"
#include "sim/link/simulator_end.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::link {
namespace {

using namespace std::chrono_literals;
using board::Clock;

constexpr Time kFirstTick{7'000'000};
constexpr auto kDelay = 400ms;  ///< of the first tick, four polls of the loop

/// A simulator in a process of its own (Cyclone DDS does not survive a fork, so fork before any DDS): it announces one fix and so many
/// blocks of sound with a tick that is late.
pid_t simulate(std::uint32_t domain, RunId run, std::uint64_t hydrophone_blocks = 0) {
  const pid_t child = fork();
  if (child != 0) return child;
  try {
    SimulatorEnd simulator(domain, run);
    while (!simulator.wait_for_runtime(100ms)) {
    }
    std::this_thread::sleep_for(kDelay);
    Tick tick;
    tick.number = 1;
    tick.time = kFirstTick;
    tick.navigation_messages = 1;
    tick.hydrophone_blocks = hydrophone_blocks;
    simulator.send(tick);
    Answer answer;
    (void)simulator.receive(answer, 5000ms);
  } catch (...) {
    std::_Exit(99);
  }
  std::_Exit(0);
}

/// What the ports have brought.
Clock::Awaited so_far(std::uint64_t navigation_taken, std::uint64_t blocks_heard) {
  return {.ports = {}, .next_turn = {}, .navigation_taken = navigation_taken, .blocks_heard = blocks_heard};
}

runtime::Outputs done() {
  runtime::Outputs outputs;
  outputs.health.state = messages::MissionState::kDone;
  return outputs;
}

/// Until the first tick is here.
void wait_for_tick(LockStepClock& clock) {
  while (!clock.has_come(100ms)) {
  }
  while (clock.wait(so_far(0, 0)) == Clock::Wake::kNothing) {
  }
}

TEST(LockStepClock, LetsNothingBeReadThatMayBelongToATickThatIsNotHereYet) {
  const RunSlot slot;
  const RunId run = new_run();
  const pid_t simulator = simulate(slot.domain(), run);
  LockStepClock clock(slot.domain(), run);
  while (!clock.has_come(100ms)) {
  }
  const Clock::Awaited none = so_far(0, 0);
  int waits = 0;
  Clock::Wake wake = clock.wait(none);
  for (; wake == Clock::Wake::kNothing; wake = clock.wait(none)) ++waits;
  EXPECT_GE(waits, 1) << "the tick was late";
  EXPECT_EQ(wake, Clock::Wake::kPorts);
  EXPECT_EQ(clock.now(), kFirstTick);
  EXPECT_EQ(clock.mission_time_of(kFirstTick), kFirstTick) << "what is dated with the tick may be read now";
  EXPECT_EQ(clock.wait(so_far(1, 0)), Clock::Wake::kTurn);
  EXPECT_TRUE(clock.take_due());
  EXPECT_FALSE(clock.take_due()) << "it gives its inputs once";
  EXPECT_FALSE(clock.answered(done(), 1));
  int status = 0;
  ASSERT_EQ(waitpid(simulator, &status, 0), simulator);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(LockStepClock, MakesNoTurnBeforeTheFixAndEveryBlockOfSoundIsThereThatTheTickAnnounced) {
  const RunSlot slot;
  const RunId run = new_run();
  const pid_t simulator = simulate(slot.domain(), run, 3);
  LockStepClock clock(slot.domain(), run);
  wait_for_tick(clock);
  EXPECT_EQ(clock.wait(so_far(1, 2)), Clock::Wake::kPorts);
  EXPECT_FALSE(clock.takes_sound_now()) << "what was heard of two of three blocks waits, however fast they were";
  EXPECT_EQ(clock.wait(so_far(0, 3)), Clock::Wake::kPorts);
  EXPECT_EQ(clock.wait(so_far(1, 3)), Clock::Wake::kTurn);
  EXPECT_TRUE(clock.takes_sound_now());
  EXPECT_FALSE(clock.answered(done(), 1));
  waitpid(simulator, nullptr, 0);
}

/// What a tick brings.
class Taken final : public board::InputSink {
 public:
  explicit Taken(const Tick& tick) { give_inputs(tick, kPort, *this); }
  void take(std::uint8_t port, const Value& value) override {
    EXPECT_EQ(port, kPort);
    if (const auto* bearing = std::get_if<messages::BearingMeasurement>(&value)) bearings.push_back(*bearing);
    if (std::holds_alternative<messages::SnrMeasurement>(value)) ++snrs;
  }
  std::vector<messages::BearingMeasurement> bearings;
  int snrs = 0;

 private:
  static constexpr std::uint8_t kPort = 3;
};

TEST(LockStepInputs, BringTheBearingOfTheTickDatedWithIt) {
  Tick tick;
  tick.time = kFirstTick;
  EXPECT_TRUE(Taken(tick).bearings.empty()) << "of a vehicle that has no array";
  tick.bearing = messages::Bearing{.direction = Radians{1.0}, .deviation = Radians{0.25}, .mirror_axis = Radians{2.0}};
  tick.snr = Decibels{12.0};
  const Taken taken(tick);
  const messages::BearingMeasurement expected{.time = kFirstTick, .bearing = *tick.bearing};
  EXPECT_EQ(taken.bearings, std::vector{expected});
  EXPECT_EQ(taken.snrs, 1);
}

TEST(LockStepClock, MakesTheTurnOfTheLastTickOfAnEarlierProcessNoSecondTime) {
  const RunSlot slot;
  const RunId run = new_run();
  const pid_t simulator = simulate(slot.domain(), run);
  LockStepClock clock(slot.domain(), run);
  messages::Health last;
  last.turn = 1;
  clock.go_on_after(last);
  while (!clock.has_come(100ms)) {
  }
  Clock::Wake wake = Clock::Wake::kNothing;
  while (wake == Clock::Wake::kNothing) wake = clock.wait(so_far(0, 0));
  EXPECT_EQ(wake, Clock::Wake::kAgain);
  kill(simulator, SIGKILL);
  waitpid(simulator, nullptr, 0);
}

TEST(LockStepClock, NamesTheHydrophonesBusWhenSoundDoesNotCome) {
  const RunSlot slot;
  const RunId run = new_run();
  const pid_t simulator = simulate(slot.domain(), run, 3);
  LockStepClock clock(slot.domain(), run);
  wait_for_tick(clock);
  while (clock.wait(so_far(1, 2)) == Clock::Wake::kPorts) {
  }
  EXPECT_TRUE(support::tells(clock.lost(), {"bus", "not heard", "--hear"}));
  kill(simulator, SIGKILL);
  waitpid(simulator, nullptr, 0);
}

TEST(LockStepClock, DatesWhatWasHeardByItsBlocksUpToTheTickAndNothingAfterIt) {
  const RunSlot slot;
  const RunId run = new_run();
  const pid_t simulator = simulate(slot.domain(), run);
  LockStepClock clock(slot.domain(), run);
  wait_for_tick(clock);
  EXPECT_EQ(clock.time_heard(kFirstTick), kFirstTick);
  EXPECT_EQ(clock.time_heard(Time{6'760'000}), Time{6'760'000}) << "filters that take 0.24 s";
  EXPECT_EQ(clock.time_heard(Time{}), Time{});
  EXPECT_EQ(clock.time_heard(kFirstTick + Duration{1}), Time{-1});
  EXPECT_EQ(clock.time_heard(Time{-2}), Time{-1});
  EXPECT_EQ(clock.mission_time_of(Time{6'760'000}), Time{-1}) << "a fix or an order of another time stays one of another flight";
  kill(simulator, SIGKILL);
  waitpid(simulator, nullptr, 0);
}

}  // namespace
}  // namespace earshot::link
