#include "sim/plot/snr_scale.hpp"

#include <gtest/gtest.h>

#include <string>

namespace earshot::plot {
namespace {

TEST(SnrScale, RunsFromTwentyDecibelsBelowTheThresholdToThirtyAboveAndItsColoursPartAtTheThreshold) {
  const std::string scale = snr_scale(Decibels{7.0});
  EXPECT_NE(scale.find("set cbrange [-13:37]"), std::string::npos) << scale;
  // Of 50 dB, 20 lie below: there the palette has two colours at one place, a pale blue and a pale yellow.
  EXPECT_NE(scale.find("20 '#bdd7e7', 20 '#fff3b0'"), std::string::npos) << scale;
}

}  // namespace
}  // namespace earshot::plot
