#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <thread>

#include "sim/link/run_slot.hpp"
#include "sim/link/runtime_end.hpp"
#include "sim/link/simulator_end.hpp"

namespace earshot::link {
namespace {

using namespace std::chrono_literals;

/// A domain that no other test or flight on this machine is in.
std::uint32_t own_domain() {
  static const RunSlot slot;
  return slot.domain();
}

constexpr std::uint64_t kNever = ~0ULL;
constexpr messages::SafetyEvent kRule{.time = {},
                                      .rule = 9,
                                      .condition = config::Condition::kBattery,
                                      .response = config::Response::kRelease,
                                      .measure = 29.998,
                                      .limit = 30.0};

Tick tick_number(std::uint64_t number) {
  Tick tick;
  tick.number = number;
  return tick;
}

Answer answer_to(std::uint64_t number) {
  Answer answer;
  answer.number = number;
  return answer;
}

/// The runtime's side in a process of its own (Cyclone DDS does not survive a fork, so fork before any DDS).
template <class Body>
pid_t in_another_process(Body body) {
  (void)own_domain();  // of this process: a child would be given another
  const pid_t child = fork();
  if (child != 0) return child;
  try {
    body();
  } catch (...) {
    std::_Exit(99);  // never back into the test program
  }
  std::_Exit(0);
}

/// What one process waits for and another says once.
class Word {
 public:
  Word() { EXPECT_EQ(pipe(ends_), 0); }
  ~Word() {
    close(ends_[0]);
    close(ends_[1]);
  }
  Word(const Word&) = delete;
  Word& operator=(const Word&) = delete;

  void say() const { EXPECT_EQ(write(ends_[1], "!", 1), 1); }
  /// @return false when it has not been said in ten seconds: who was to say it is gone
  [[nodiscard]] bool comes() const {
    pollfd ready{.fd = ends_[0], .events = POLLIN, .revents = 0};
    char heard = 0;
    return poll(&ready, 1, 10'000) == 1 && read(ends_[0], &heard, 1) == 1;
  }
  void wait() const {
    if (!comes()) std::_Exit(98);
  }

 private:
  int ends_[2] = {-1, -1};
};

/// Answers every tick with its own number and, as steps, a hash of all that the tick said.
void answer_every_tick(std::uint64_t until) {
  RuntimeEnd link(own_domain());
  Tick tick;
  while (tick.number != until && link.receive(tick, 5000ms) == Delivery::kArrived) {
    link.send({.number = tick.number,
               .setpoint_messages = tick.navigation_messages + 1 + 1000 * tick.hydrophone_blocks,
               .steps_taken = static_cast<std::uint32_t>(tick.time.us / 1'000'000),
               .state = tick.command,
               .end_reason = static_cast<std::uint8_t>(tick.snr ? tick.snr->value : 99.0),
               .believed_source = tick.snr ? std::optional(NorthEast{Meters{1.5}, Meters{-tick.snr->value}}) : std::nullopt,
               .mismatch_bits = 0.5F * static_cast<float>(tick.number),
               .is_sweeping = tick.number % 2 == 1,
               .is_found = tick.number % 3 == 0,
               .rule = tick.number % 5 == 0 ? std::optional(kRule) : std::nullopt});
  }
}

/// Passes over answers to knocks: on a busy machine a second knock goes out before the first is answered.
Delivery receive_behind_knocks(SimulatorEnd& link, Answer& answer) {
  Delivery delivery = link.receive(answer, 5000ms);
  while (delivery == Delivery::kArrived && answer.number == 0) delivery = link.receive(answer, 5000ms);
  return delivery;
}

TEST(LockStep, EveryTickIsAnsweredInOrderWithWhatItSaid) {
  constexpr std::uint64_t kTicks = 2000;
  const pid_t child = in_another_process([] { answer_every_tick(kTicks); });
  SimulatorEnd link(own_domain());
  ASSERT_TRUE(link.wait_for_runtime(10s));
  for (std::uint64_t n = 1; n <= kTicks; ++n) {
    link.send({.number = n,
               .time = {static_cast<std::int64_t>(n) * 1'000'000},
               .navigation_messages = 3 * n,
               .hydrophone_blocks = 5 * n,
               .snr = n % 2 == 0 ? std::optional(Decibels{12.0}) : std::nullopt,
               .command = static_cast<std::uint8_t>(n % 4)});
    Answer answer;
    ASSERT_EQ(receive_behind_knocks(link, answer), Delivery::kArrived) << "tick " << n;
    EXPECT_EQ(answer.number, n);
    EXPECT_EQ(answer.setpoint_messages, 5003 * n + 1) << "3 fixes and 5 blocks of sound for each tick";
    EXPECT_EQ(answer.steps_taken, n);
    EXPECT_EQ(answer.state, n % 4);
    EXPECT_EQ(answer.end_reason, n % 2 == 0 ? 12 : 99);
    EXPECT_EQ(answer.believed_source, n % 2 == 0 ? std::optional(NorthEast{Meters{1.5}, Meters{-12.0}}) : std::nullopt);
    EXPECT_EQ(answer.mismatch_bits, 0.5F * static_cast<float>(n));
    EXPECT_EQ(answer.is_sweeping, n % 2 == 1);
    EXPECT_EQ(answer.is_found, n % 3 == 0);
    EXPECT_EQ(answer.rule, n % 5 == 0 ? std::optional(kRule) : std::nullopt);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(LockStep, ABearingArrivesWithItsTickAsItWasSent) {
  const messages::Bearing sure{.direction = Radians{1.25}, .deviation = Radians{0.5}};
  messages::Bearing ambiguous = sure;
  ambiguous.mirror_axis = Radians{2.75};
  const std::array<std::optional<messages::Bearing>, 3> sent{std::nullopt, sure, ambiguous};
  const pid_t child = in_another_process([&sent] {
    RuntimeEnd link(own_domain());
    Tick tick;
    for (std::uint64_t n = 1; n <= sent.size(); ++n) {
      if (link.receive(tick, 10s) != Delivery::kArrived || tick.number != n) std::_Exit(1);
      Answer answer = answer_to(n);
      answer.is_found = tick.bearing == sent[n - 1];
      link.send(answer);
    }
  });
  SimulatorEnd link(own_domain());
  ASSERT_TRUE(link.wait_for_runtime(10s));
  for (std::uint64_t n = 1; n <= sent.size(); ++n) {
    Tick tick = tick_number(n);
    tick.bearing = sent[n - 1];
    link.send(tick);
    Answer answer;
    ASSERT_EQ(receive_behind_knocks(link, answer), Delivery::kArrived) << "tick " << n;
    EXPECT_TRUE(answer.is_found) << "tick " << n;
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(LockStep, TheFirstTickIsAnsweredHoweverEarlyItIsSent) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const pid_t child = in_another_process([] { answer_every_tick(1); });
    SimulatorEnd link(own_domain());
    ASSERT_TRUE(link.wait_for_runtime(10s));
    link.send(tick_number(1));
    Answer answer;
    ASSERT_EQ(receive_behind_knocks(link, answer), Delivery::kArrived) << "attempt " << attempt;
    EXPECT_EQ(answer.number, 1);
    waitpid(child, nullptr, 0);
  }
}

TEST(LockStep, ASimulatorLearnsThatItsRuntimeWasKilled) {
  const pid_t child = in_another_process([] { answer_every_tick(kNever); });
  SimulatorEnd link(own_domain());
  ASSERT_TRUE(link.wait_for_runtime(10s));
  link.send(tick_number(1));
  Answer answer;
  ASSERT_EQ(receive_behind_knocks(link, answer), Delivery::kArrived);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  // The bar allows 5 s; the lease runs out after 3 s.
  EXPECT_EQ(link.receive(answer, 5000ms), Delivery::kLost);
}

TEST(LockStep, ARuntimeStillGetsTheLastTickOfASimulatorThatHasLeft) {
  const Word has_left;
  const pid_t child = in_another_process([&has_left] {
    RuntimeEnd link(own_domain());
    Tick tick;
    if (link.receive(tick, 10s) != Delivery::kArrived || tick.number != 1) std::_Exit(1);
    link.send(answer_to(1));
    has_left.wait();  // and has sent tick 2 before
    if (link.receive(tick, 5s) != Delivery::kArrived || tick.number != 2) std::_Exit(2);
    if (link.receive(tick, 5s) != Delivery::kLost) std::_Exit(3);
  });
  {
    SimulatorEnd link(own_domain());
    ASSERT_TRUE(link.wait_for_runtime(10s));
    link.send(tick_number(1));
    Answer answer;
    ASSERT_EQ(receive_behind_knocks(link, answer), Delivery::kArrived);
    link.send(tick_number(2));
  }
  has_left.say();
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

/// Exchanges one tick; the answer.
Answer exchange(SimulatorEnd& link, std::uint64_t number) {
  link.send(tick_number(number));
  Answer answer;
  EXPECT_EQ(receive_behind_knocks(link, answer), Delivery::kArrived) << "tick " << number;
  EXPECT_EQ(answer.number, number);
  return answer;
}

TEST(LockStep, ASecondSimulatorInTheDomainFindsNobodyAndTheFirstGoesOn) {
  const pid_t runtime = in_another_process([] {
    RuntimeEnd link(own_domain());
    for (Tick tick; link.receive(tick, 5000ms) == Delivery::kArrived;) {
      Answer answer = answer_to(tick.number);
      answer.setpoint_messages = link.strangers();
      link.send(answer);
    }
  });
  const Word begin;
  const pid_t stranger = in_another_process([&begin] {
    begin.wait();
    SimulatorEnd second(own_domain());
    if (second.wait_for_runtime(500ms)) std::_Exit(1);
    second.send(tick_number(7));  // and does not mind
    std::this_thread::sleep_for(100ms);
  });
  SimulatorEnd link(own_domain());
  ASSERT_TRUE(link.wait_for_runtime(10s));
  std::uint64_t number = 0;
  exchange(link, ++number);
  begin.say();
  int status = -1;
  while (waitpid(stranger, &status, WNOHANG) == 0) exchange(link, ++number);
  EXPECT_EQ(status, 0) << "the second simulator was answered";
  EXPECT_GE(exchange(link, ++number).setpoint_messages, 2) << "knocks and a tick of the second simulator are counted";
  kill(runtime, SIGKILL);
  waitpid(runtime, nullptr, 0);
}

TEST(LockStep, ARuntimeThatWasToldItsRunHearsNoOther) {
  constexpr RunId kRun = 42;
  const pid_t child = in_another_process([] {
    RuntimeEnd link(own_domain(), kRun);
    for (Tick tick; link.receive(tick, 5000ms) == Delivery::kArrived;) link.send(answer_to(tick.number));
  });
  EXPECT_FALSE(SimulatorEnd(own_domain(), kRun + 1).wait_for_runtime(500ms));
  SimulatorEnd link(own_domain(), kRun);
  EXPECT_TRUE(link.wait_for_runtime(10s));
  exchange(link, 1);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST(LockStep, ASimulatorMissesItsRuntimeAlsoWhenAnotherIsInTheDomain) {
  const pid_t child = in_another_process([] { answer_every_tick(kNever); });
  const pid_t other = in_another_process([] {
    RuntimeEnd link(own_domain(), RunId{1});  // of a run that never comes
    (void)link.wait_for_simulator(60s);
  });
  SimulatorEnd link(own_domain());
  ASSERT_TRUE(link.wait_for_runtime(10s));
  exchange(link, 1);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  Answer answer;
  EXPECT_EQ(link.receive(answer, 5000ms), Delivery::kLost);
  kill(other, SIGKILL);
  waitpid(other, nullptr, 0);
}

TEST(LockStep, ASimulatorThatGivesUpItsRuntimeStillCountsTheStrangersBefore) {
  const pid_t stranger = in_another_process([] {
    RuntimeEnd link(own_domain(), RunId{42});
    for (;;) {
      link.send(answer_to(1));
      std::this_thread::sleep_for(20ms);
    }
  });
  SimulatorEnd link(own_domain(), RunId{43});
  while (link.strangers() < 3) std::this_thread::sleep_for(10ms);
  kill(stranger, SIGKILL);
  waitpid(stranger, nullptr, 0);
  link.give_up_runtime();
  EXPECT_GE(link.strangers(), 3U);
}

TEST(LockStep, RunsInTwoDomainsDoNotMeet) {
  const Word is_there;
  const pid_t child = in_another_process([&is_there] {
    RuntimeEnd link(own_domain());
    is_there.say();
    for (Tick tick; link.receive(tick, 10s) == Delivery::kArrived;) link.send(answer_to(tick.number));
  });
  ASSERT_TRUE(is_there.comes());
  SimulatorEnd elsewhere(kLowestDomain - 1);
  EXPECT_FALSE(elsewhere.wait_for_runtime(500ms));
  SimulatorEnd here(own_domain());
  EXPECT_TRUE(here.wait_for_runtime(10s)) << "it was there all the time";
  exchange(here, 1);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

}  // namespace
}  // namespace earshot::link
