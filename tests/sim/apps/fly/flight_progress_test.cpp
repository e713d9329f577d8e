#include "sim/apps/fly/flight_progress.hpp"

#include <gtest/gtest.h>

#include "tests/support/text/tells.hpp"

namespace earshot::fly {
namespace {

TEST(FlightProgress, TellsTimeStepUnderWaySnrAndTheRangeBelieved) {
  const FlightProgress progress{.at_sea = Duration::seconds(72 * 60 + 59),
                                .steps_taken = 8,
                                .max_steps = 100,
                                .reception = {.snr = Decibels{14.24}},
                                .believed_range = Meters{6'260.0}};
  EXPECT_TRUE(support::tells(to_string(progress), {"1 h", "13 min", "step 9", "100", "SNR", "14.2 dB", "6.3 km"}));
}

TEST(FlightProgress, TellsNoRangeWithoutABeliefAndNoSnrThatWasNotMeasured) {
  const FlightProgress progress{.at_sea = Duration::seconds(65),
                                .steps_taken = 100,
                                .max_steps = 100,
                                .reception = {.snr = Decibels{-5.0}, .too_faint = true},
                                .believed_range = {}};
  EXPECT_TRUE(support::tells(to_string(progress), {"65 s", "step 100", "100", "SNR", "below -5.0 dB"}));
}

TEST(FlightProgress, TellsOfAVehicleThatLearnsTheNoiseThatItHasHeardNothingYet) {
  const FlightProgress progress{
      .at_sea = Duration::seconds(65), .max_steps = 100, .reception = {}, .is_learning_noise = true, .believed_range = {}};
  EXPECT_TRUE(support::tells(to_string(progress), {"65 s", "learning", "before", "search"}));
}

}  // namespace
}  // namespace earshot::fly
