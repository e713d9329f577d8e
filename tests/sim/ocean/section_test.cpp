#include "sim/ocean/section.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace earshot::ocean {
namespace {

SedimentLayer mud(double thickness_m, double sound_speed_mps) {
  return {.thickness = Meters{thickness_m}, .sound_speed = MetersPerSecond{sound_speed_mps}};
}

TabulatedProfile isovelocity(double sound_speed_mps) {
  return {.depth_m = {0.0}, .sound_speed_mps = {sound_speed_mps}};
}

TEST(RadialSection, IsLinearInRangeBetweenItsStations) {
  const Section section{
      .water = {{.range = Meters{0.0}, .profile = isovelocity(1500.0)}, {.range = Meters{1000.0}, .profile = isovelocity(1520.0)}},
      .sea_floor = {{.range = Meters{500.0}, .depth = Meters{200.0}}, {.range = Meters{2500.0}, .depth = Meters{100.0}}},
      .sediment = {{.range = Meters{0.0}, .layers = {mud(10.0, 1600.0), mud(0.0, 1800.0)}},
                   {.range = Meters{4000.0}, .layers = {mud(30.0, 1640.0), mud(0.0, 1880.0)}}}};
  EXPECT_EQ(sound_speed(section, Meters{250.0}, Meters{50.0}), MetersPerSecond{1505.0});
  EXPECT_EQ(sound_speed(section, Meters{9000.0}, Meters{50.0}), MetersPerSecond{1520.0});
  EXPECT_EQ(sea_floor_depth(section, Meters{0.0}), Meters{200.0});
  EXPECT_EQ(sea_floor_depth(section, Meters{1500.0}), Meters{150.0});
  EXPECT_EQ(sea_floor_depth(section, Meters{9000.0}), Meters{100.0});
}

TEST(RadialSection, HoldsASedimentFromItsStationToTheNext) {
  Section section{.water = {}, .sea_floor = {}, .sediment = {}};
  section.sediment = {{.range = Meters{100.0}, .layers = {mud(10.0, 1600.0), mud(0.0, 1800.0)}},
                      {.range = Meters{4000.0}, .layers = {mud(0.0, 1880.0)}}};
  EXPECT_EQ(sediment_at(section, Meters{0.0}).layers.size(), 2U);
  EXPECT_EQ(sediment_at(section, Meters{3999.0}).layers.front().sound_speed, MetersPerSecond{1600.0});
  EXPECT_EQ(sediment_at(section, Meters{4000.0}).layers.front().sound_speed, MetersPerSecond{1880.0});
}

}  // namespace
}  // namespace earshot::ocean
