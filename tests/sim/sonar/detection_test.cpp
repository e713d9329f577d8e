#include "sim/sonar/detection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace earshot::sonar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// SNR = 100 - TL; 10 dB are needed.
Detector detector(double fluctuation_db) {
  return {.source_level = Decibels{190.0},
          .noise_level = Decibels{90.0},
          .detection_threshold = Decibels{10.0},
          .fluctuation = Decibels{fluctuation_db}};
}

TEST(DetectionProbability, FollowsTheTableOfTheNormalDistribution) {
  // Abramowitz & Stegun, table 26.1, to its fifth place.
  EXPECT_NEAR(detection_probability(Decibels{10.0}, detector(6.0)), 0.5, 1e-12);
  EXPECT_NEAR(detection_probability(Decibels{16.0}, detector(6.0)), 0.84134, 5e-6);
  EXPECT_NEAR(detection_probability(Decibels{-2.0}, detector(6.0)), 0.02275, 5e-6);
  EXPECT_NEAR(detection_probability(Decibels{10.0 + 1.64485 * 3.0}, detector(3.0)), 0.95, 5e-6);
}

TEST(DetectionProbability, IsTheThresholdDetectorWithoutFluctuation) {
  EXPECT_EQ(detection_probability(Decibels{10.0}, detector(0.0)), 1.0);
  EXPECT_EQ(detection_probability(Decibels{9.999}, detector(0.0)), 0.0);
}

TEST(DetectionProbability, IsUnknownWhereThereIsNoWater) {
  EXPECT_TRUE(std::isnan(detection_probability(Decibels{kNaN}, detector(0.0))));
  EXPECT_TRUE(std::isnan(detection_probability(Decibels{kNaN}, detector(6.0))));
}

/// One radial with ranges 100 m, 200 m, ...
DetectionRange range_of(const std::vector<float>& loss_db) {
  const Fan fan{.centre = {},
                .bearings = 1,
                .ranges = loss_db.size(),
                .range_step = Meters{100.0},
                .depth_m = {300.0},
                .transmission_loss_db = loss_db,
                .sea_floor_depth_m = {}};
  return detection_ranges(fan, 0, detector(0.0)).front();
}

TEST(DetectionRange, LiesWhereTheLossCrossesNinetyDecibels) {
  const DetectionRange range = range_of({80, 84, 88, 96, 99});  // 90 dB a quarter of the way from 300 m to 400 m
  EXPECT_NEAR(range.furthest_m, 325.0, 1e-9);
  EXPECT_EQ(range.assured_m, range.furthest_m);
}

TEST(DetectionRange, CountsAConvergenceZoneAsFurthestAndNotAsAssured) {
  const DetectionRange range = range_of({80, 88, 92, 100, 89, 91});
  EXPECT_NEAR(range.assured_m, 250.0, 1e-9);
  EXPECT_NEAR(range.furthest_m, 550.0, 1e-9);
}

TEST(DetectionRange, EndsAtTheShoreAndAtTheEndOfTheRadial) {
  const auto land = static_cast<float>(kNaN);
  EXPECT_EQ(range_of({80, 82, land, land}).furthest_m, 200.0);
  EXPECT_EQ(range_of({80, 82, 84}).furthest_m, 300.0);
  EXPECT_EQ(range_of({80, 89.5}).furthest_m, 200.0);
  EXPECT_EQ(range_of({80, 90}).furthest_m, 200.0);  // 10 dB are enough
}

TEST(DetectionRange, IsZeroWhereNothingIsHeardAndUnknownWhereItBeginsWithoutWater) {
  EXPECT_EQ(range_of({91, 95}).furthest_m, 0.0);
  EXPECT_EQ(range_of({91, 95}).assured_m, 0.0);
  EXPECT_TRUE(std::isnan(range_of({static_cast<float>(kNaN), 80}).furthest_m));
}

TEST(DetectionRange, IsThatOfItsOwnBearingAndDepth) {
  // Two bearings, two ranges, two depths; at the first depth nothing is heard on the first bearing.
  const Fan fan{.centre = {},
                .bearings = 2,
                .ranges = 2,
                .range_step = Meters{100.0},
                .depth_m = {30.0, 300.0},
                .transmission_loss_db = {95, 80, 95, 85, 88, 95, 92, 99},
                .sea_floor_depth_m = {}};
  const std::vector<DetectionRange> shallow = detection_ranges(fan, 0, detector(0.0));
  const std::vector<DetectionRange> deep = detection_ranges(fan, 1, detector(0.0));
  ASSERT_EQ(shallow.size(), 2U);
  EXPECT_EQ(shallow[0].furthest_m, 0.0);
  EXPECT_NEAR(shallow[1].furthest_m, 150.0, 1e-9);
  EXPECT_EQ(deep[0].furthest_m, 200.0);  // to its last range and no further: 95 dB is the next bearing's
  EXPECT_EQ(deep[0].assured_m, 200.0);
  EXPECT_EQ(deep[1].furthest_m, 0.0);
}

}  // namespace
}  // namespace earshot::sonar
