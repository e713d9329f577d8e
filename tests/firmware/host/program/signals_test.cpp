#include "firmware/host/program/signals.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace earshot::program {
namespace {

/// What a child process ends with that gets `number` twice after `prepare`: 0 and 1, whether it was asked to stop.
template <typename Prepare>
void get_twice(int number, Prepare prepare) {
  prepare();
  (void)std::raise(number);
  (void)std::raise(number);
  std::exit(stop_requested ? 1 : 0);
}

TEST(StopOnSignals, AsksTheProgramToStopAndLeavesItTheTime) {
  for (const int number : {SIGINT, SIGTERM, SIGQUIT})
    EXPECT_EXIT(get_twice(number, [] { stop_on_signals(); }), testing::ExitedWithCode(1), "") << number;
}

TEST(StopOnSignals, EndsTheProgramAtTheSecondWhereThatIsWanted) {
  for (const int number : {SIGINT, SIGTERM, SIGQUIT})
    EXPECT_EXIT(get_twice(number, [] { stop_on_signals(SecondSignal::kEndsAtOnce); }), testing::KilledBySignal(number), "") << number;
}

TEST(StopOnSighup, AsksTheProgramToStopWhenItsTerminalIsGone) {
  EXPECT_EXIT(get_twice(SIGHUP, stop_on_sighup), testing::ExitedWithCode(1), "");
}

TEST(IgnoreUnmeantSignals, LetsNothingEndTheProgramThatNobodyMeansToStopItBy) {
  for (const int number : {SIGHUP, SIGTSTP, SIGTTIN, SIGTTOU, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGIO, SIGPWR, SIGSTKFLT,
                           SIGXCPU, SIGRTMIN, SIGRTMAX})
    EXPECT_EXIT(get_twice(number, ignore_unmeant_signals), testing::ExitedWithCode(0), "") << number;
}

TEST(IgnoreUnmeantSignals, LeavesWhatStopsAProgram) {
  EXPECT_EXIT(get_twice(SIGTERM, ignore_unmeant_signals), testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace earshot::program
