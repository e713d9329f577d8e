#include "firmware/detector/threshold_detector.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace earshot::detector {
namespace {

constexpr ThresholdDetector kDetector{.detection_threshold = Decibels{10}};

TEST(ThresholdDetector, HearsTheSourceAtExactlyTheThreshold) {
  EXPECT_TRUE(kDetector.detects(Decibels{10}));
}

TEST(ThresholdDetector, HearsNothingJustBelowTheThreshold) {
  EXPECT_FALSE(kDetector.detects(Decibels{9.999999}));
}

TEST(ThresholdDetector, HearsNothingInAnSnrThatIsNotANumber) {
  EXPECT_FALSE(kDetector.detects(Decibels{std::numeric_limits<double>::quiet_NaN()}));
}

}  // namespace
}  // namespace earshot::detector
