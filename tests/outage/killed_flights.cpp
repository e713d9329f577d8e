// Flights whose runtime is killed at every decision: tests/outage/run. One of them is a test of its own (resume_flight_test).

#include <string>

#include "tests/scenario/resumed_flight.hpp"

namespace earshot {
namespace {

constexpr int kSteps = 40;

class KilledFlight : public ResumedFlight {
 protected:
  KilledFlight() : ResumedFlight(kSteps) {}
};

TEST_F(KilledFlight, GivenAKillAtOneDecisionOfEachFlightTheRestOfEachIsTheSameByteForByte) {
  fly_whole();
  for (int decisions = 1; decisions <= kSteps; ++decisions) {
    const std::string out = "killed-" + std::to_string(decisions);
    start_runtime(out);
    start_simulator(out);
    kill_runtime_after(out, decisions);
    expect_same_as_whole(out);
    ASSERT_FALSE(HasFailure()) << "killed at decision " << decisions;
  }
}

TEST_F(KilledFlight, GivenAKillAtEveryDecisionOfOneFlightItIsTheSameByteForByte) {
  fly_whole();
  start_runtime("killed");
  start_simulator("killed");
  for (int decisions = 1; decisions <= kSteps; ++decisions) kill_runtime_after("killed", decisions);
  expect_same_as_whole("killed");
}

}  // namespace
}  // namespace earshot
