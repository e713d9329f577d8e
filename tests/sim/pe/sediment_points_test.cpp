#include "sim/pe/sediment_points.hpp"

#include <gtest/gtest.h>

namespace earshot::pe {
namespace {

TEST(SedimentPoints, MakeInterfacesOfLayers) {
  const auto points = sediment_points(
      {{.thickness = Meters{20.0}, .sound_speed = MetersPerSecond{1500.0}}, {.thickness = {}, .sound_speed = MetersPerSecond{1800.0}}});
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[1].depth_below_floor_m, 20.0);
  EXPECT_EQ(points[1].sound_speed_mps, 1500.0);
  EXPECT_EQ(points[2].depth_below_floor_m, 20.0);
  EXPECT_EQ(points[2].sound_speed_mps, 1800.0);
}

}  // namespace
}  // namespace earshot::pe
