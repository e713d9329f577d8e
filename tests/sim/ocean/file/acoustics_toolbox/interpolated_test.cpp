#include "sim/ocean/file/acoustics_toolbox/interpolated.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace earshot::ocean::acoustics_toolbox {
namespace {

constexpr double kTolerance_mps = 1.001e-3;  // what interpolated() promises, and the rounding of what is printed

double speed_at(const TabulatedProfile& given, Interpolation interpolation, double depth_m) {
  return sound_speed(interpolated(given, interpolation), Meters{depth_m}).value;
}

TEST(InterpolatedProfile, StaysAsItIsWhereItIsLinear) {
  const TabulatedProfile given{.depth_m = {0.0, 40.0, 100.0}, .sound_speed_mps = {1500.0, 1520.0, 1490.0}};
  EXPECT_EQ(interpolated(given, Interpolation::kLinear).depth_m, given.depth_m);
  EXPECT_EQ(interpolated(given, Interpolation::kRangesAndDepths).sound_speed_mps, given.sound_speed_mps);
}

TEST(InterpolatedProfile, HasTheMeanOfTheSquaredIndexHalfWayDown) {
  // 1 / sqrt((1/1500^2 + 1/1600^2) / 2)
  EXPECT_NEAR(speed_at({.depth_m = {0.0, 100.0}, .sound_speed_mps = {1500.0, 1600.0}}, Interpolation::kSquaredIndex, 50.0), 1547.582113,
              kTolerance_mps);
}

TEST(InterpolatedProfile, FollowsTheSplineOfAnIndependentTool) {
  // scipy 1.15, CubicSpline, whose default is "not-a-knot".
  const TabulatedProfile six{.depth_m = {0.0, 100.0, 300.0, 700.0, 1500.0, 3000.0},
                             .sound_speed_mps = {1530.0, 1522.0, 1505.0, 1490.0, 1500.0, 1525.0}};
  const std::vector<double> depth_m{50.0, 200.0, 500.0, 1100.0, 2200.0};
  const std::vector<double> speed_mps{1526.20301, 1513.150368, 1494.446502, 1490.939035, 1521.072345};
  for (std::size_t i = 0; i < depth_m.size(); ++i)
    EXPECT_NEAR(speed_at(six, Interpolation::kSpline, depth_m[i]), speed_mps[i], kTolerance_mps) << depth_m[i];
  const TabulatedProfile four{.depth_m = {0.0, 100.0, 300.0, 700.0}, .sound_speed_mps = {1530.0, 1522.0, 1505.0, 1490.0}};
  EXPECT_NEAR(speed_at(four, Interpolation::kSpline, 500.0), 1492.142857, kTolerance_mps);
  const TabulatedProfile three{.depth_m = {0.0, 100.0, 300.0}, .sound_speed_mps = {1530.0, 1522.0, 1505.0}};
  EXPECT_NEAR(speed_at(three, Interpolation::kSpline, 200.0), 1513.666667, kTolerance_mps);
  const TabulatedProfile two{.depth_m = {0.0, 100.0}, .sound_speed_mps = {1530.0, 1520.0}};
  EXPECT_EQ(speed_at(two, Interpolation::kSpline, 50.0), 1525.0);
}

}  // namespace
}  // namespace earshot::ocean::acoustics_toolbox
