#include "hil/nodes/vehicle/helm.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace earshot::hil {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr vehicle::Command kResting{.heading = Radians{1.0}, .speed = MetersPerSecond{2.0}, .depth = Meters{300.0}};

/// Set-points that it takes.
std::uint64_t taken(double heading_rad, double speed_mps, double depth_m) {
  Helm helm(kResting);
  helm.take({.heading = Radians{heading_rad}, .speed = MetersPerSecond{speed_mps}, .depth = Meters{depth_m}, .waypoint = {}}, Time{});
  return helm.taken();
}

TEST(Helm, TakesWhatAVehicleCanDo) {
  EXPECT_EQ(taken(-3.1, 0.0, 0.0), 1U);
  EXPECT_EQ(taken(6.2, 5.0, 11'000.0), 1U);
}

/// A bit of a set-point that is another makes 2 m/s 3.6e154 m/s: a vehicle that followed would be out of any polygon in a second.
TEST(Helm, TakesNothingThatNoVehicleDoes) {
  EXPECT_EQ(taken(0.5, 3.6e154, 300.0), 0U);
  EXPECT_EQ(taken(0.5, 5.1, 300.0), 0U);
  EXPECT_EQ(taken(0.5, -0.1, 300.0), 0U);
  EXPECT_EQ(taken(0.5, 2.0, -0.1), 0U);
  EXPECT_EQ(taken(0.5, 2.0, 11'001.0), 0U);
  EXPECT_EQ(taken(6.3, 2.0, 300.0), 0U);
  EXPECT_EQ(taken(kNaN, 2.0, 300.0), 0U);
  EXPECT_EQ(taken(0.5, kNaN, 300.0), 0U);
  EXPECT_EQ(taken(0.5, 2.0, kNaN), 0U);
}

}  // namespace
}  // namespace earshot::hil
