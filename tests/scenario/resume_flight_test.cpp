// Flights whose runtime is killed and goes on from its journal.

#include "tests/scenario/resumed_flight.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

TEST_F(ResumedFlight, GivenItsRuntimeIsKilledInMidSearchAndStartedAgainTheRestOfTheFlightIsTheSameByteForByte) {
  fly_whole();
  start_runtime("killed");
  start_simulator("killed");
  kill_runtime_after("killed", 2);
  expect_same_as_whole("killed");
}

TEST_F(ResumedFlight, GivenAnArrayTheBearingThatIsSaidAgainCountsOnceAndTheRestOfTheFlightIsTheSameByteForByte) {
  environment_ = folder_ / "array.toml";
  std::ofstream(environment_) << support::read_text(kEnvironment) << "\n[conditions]\nbearing_deg = 10.0\n";
  fly_whole();
  start_runtime("killed");
  start_simulator("killed");
  kill_runtime_after("killed", 2);
  expect_same_as_whole("killed");
}

/// So many steps that a machine which tests share never has it over before its second decision is seen.
class LostFlight : public ResumedFlight {
 protected:
  LostFlight() : ResumedFlight(100) {}
};

TEST_F(LostFlight, GivenItsRuntimeComesBackWithoutItsJournalTheFlightIsLostAndSaysWhy) {
  start_runtime("killed");
  start_simulator("killed");
  // The second, for the first is in the journal before the simulator has its turn: who is killed between them has lost nothing.
  ASSERT_TRUE(has_decided("killed", 2)) << runtime_->output();
  runtime_->signal(SIGKILL);
  (void)runtime_->wait(5s);
  start_runtime("other");
  EXPECT_EQ(simulator_->wait(60s), 3);
  EXPECT_TRUE(support::has_line(simulator_->output(), {"earshotd", "0 turns", "journal"})) << simulator_->output();
}

}  // namespace
}  // namespace earshot
