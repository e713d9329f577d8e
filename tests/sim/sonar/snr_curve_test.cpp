#include "sim/sonar/snr_curve.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace earshot::sonar {
namespace {

const SnrCurve kCurve{Meters{10.0}, {30.0F, 20.0F, 5.0F}};

TEST(SnrCurve, GivesItsSamplesAtTheirRanges) {
  EXPECT_EQ(kCurve.at(Meters{0.0}), Decibels{30.0});
  EXPECT_EQ(kCurve.at(Meters{10.0}), Decibels{20.0});
  EXPECT_EQ(kCurve.at(Meters{20.0}), Decibels{5.0});
}

TEST(SnrCurve, IsLinearInDecibelsBetweenItsSamples) {
  EXPECT_DOUBLE_EQ(kCurve.at(Meters{2.5}).value, 27.5);
  EXPECT_DOUBLE_EQ(kCurve.at(Meters{15.0}).value, 12.5);
}

TEST(SnrCurve, HoldsItsLastSampleBeyondItsEnd) {
  EXPECT_EQ(kCurve.at(Meters{1e9}), Decibels{5.0});
  EXPECT_EQ(kCurve.max_range(), Meters{20.0});
  EXPECT_EQ(kCurve.range_step(), Meters{10.0});
  EXPECT_EQ(kCurve.samples_db(), (std::vector<float>{30.0F, 20.0F, 5.0F}));
}

TEST(SnrCurve, GivesItsFirstSampleForNonsense) {
  EXPECT_EQ(kCurve.at(Meters{-5.0}), Decibels{30.0});
  EXPECT_EQ(kCurve.at(Meters{std::numeric_limits<double>::quiet_NaN()}), Decibels{30.0});
}

}  // namespace
}  // namespace earshot::sonar
