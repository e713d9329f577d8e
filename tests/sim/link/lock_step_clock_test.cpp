#include "sim/link/lock_step_clock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "sim/link/run_slot.hpp"
#include "sim/link/simulator_end.hpp"

namespace earshot::link {
namespace {

using namespace std::chrono_literals;
using board::Clock;

constexpr Time kFirstTick{7'000'000};
constexpr auto kDelay = 400ms;  ///< of the first tick, four looks of the loop

/// A simulator in a process of its own (Cyclone DDS does not survive a fork, so fork before any DDS): it announces one fix with a tick that
/// is late.
pid_t simulate(std::uint32_t domain, RunId run) {
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
    simulator.send(tick);
    Answer answer;
    (void)simulator.receive(answer, 5000ms);
  } catch (...) {
    std::_Exit(99);
  }
  std::_Exit(0);
}

TEST(LockStepClock, LetsNothingBeReadThatMayBelongToATickThatIsNotHereYet) {
  const RunSlot slot;
  const RunId run = new_run();
  const pid_t simulator = simulate(slot.domain(), run);
  LockStepClock clock(slot.domain(), run);
  while (!clock.has_come(100ms)) {
  }
  const Clock::Awaited none{.ports = {}, .next_turn = {}, .navigation_taken = 0};
  int looks = 0;
  Clock::Wake wake = clock.wait(none);
  for (; wake == Clock::Wake::kNothing; wake = clock.wait(none)) ++looks;
  EXPECT_GE(looks, 1) << "the tick was late";
  EXPECT_EQ(wake, Clock::Wake::kPorts);
  EXPECT_EQ(clock.now(), kFirstTick);
  EXPECT_EQ(clock.mission_time_of(kFirstTick), kFirstTick) << "what is dated with the tick may be read now";
  EXPECT_EQ(clock.wait({.ports = {}, .next_turn = {}, .navigation_taken = 1}), Clock::Wake::kTurn);
  runtime::Outputs done;
  done.health.state = messages::MissionState::kDone;
  EXPECT_FALSE(clock.answered(done, 1));
  int status = 0;
  ASSERT_EQ(waitpid(simulator, &status, 0), simulator);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace earshot::link
