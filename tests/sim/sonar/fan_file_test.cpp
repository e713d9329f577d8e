#include "sim/sonar/fan_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "sim/netcdf/reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::sonar {
namespace {

constexpr float kLand = std::numeric_limits<float>::quiet_NaN();
constexpr Detector kDetector{
    .source_level = Decibels{190.0}, .noise_level = Decibels{90.0}, .detection_threshold = Decibels{10.0}, .fluctuation = Decibels{6.0}};

ocean::Environment environment() {
  ocean::Environment small;
  small.name = "small";
  return small;
}

/// Two bearings, three ranges, one depth.
Fan fan() {
  return {.centre = {Meters{10.0}, Meters{20.0}},
          .bearings = 2,
          .ranges = 3,
          .range_step = Meters{100.0},
          .depth_m = {300.0},
          .transmission_loss_db = {80, 84, 96, 84, kLand, kLand},
          .sea_floor_depth_m = {500, 400, 350, 320, 0, 0}};
}

TEST(FanFile, ReadsBackLossProbabilityAndDetectionRanges) {
  const support::TemporaryFolder folder;
  write_fan(folder / "fan.nc", fan(), std::nullopt, environment(), {Hertz{20.0}, Hertz{20.0}}, kDetector, "by hand");
  const netcdf::Reader file(folder / "fan.nc");
  EXPECT_EQ(file.dimensions_of("transmission_loss"), (std::vector<std::string>{"bearing", "range", "depth"}));
  EXPECT_EQ(file.read("bearing"), (std::vector<double>{0.0, 180.0}));
  EXPECT_EQ(file.read("range"), (std::vector<double>{100.0, 200.0, 300.0}));
  EXPECT_EQ(file.read("transmission_loss")[1], 84.0);
  EXPECT_NEAR(file.read("detection_probability")[1], 0.84134, 5e-6);  // one sigma: Abramowitz & Stegun, table 26.1
  EXPECT_TRUE(std::isnan(file.read("transmission_loss")[4]));
  EXPECT_EQ(file.read("furthest_detection_range"), (std::vector<double>{250.0, 100.0}));
  EXPECT_EQ(file.text_attribute("sea_floor_depth", "standard_name"), "sea_floor_depth_below_sea_surface");
  EXPECT_FALSE(file.has_variable("snr"));
  EXPECT_FALSE(file.has_variable("map_snr"));
}

TEST(FanFile, HoldsTheMapBesideTheFan) {
  const support::TemporaryFolder folder;
  const HorizontalMap map = make_map(fan(), 0, {.side = Meters{200.0}, .intervals = 2}, kDetector);
  write_fan(folder / "fan.nc", fan(), map, environment(), {Hertz{15.0}, Hertz{30.0}, 3}, kDetector, "by hand");
  const netcdf::Reader file(folder / "fan.nc");
  EXPECT_EQ(file.dimensions_of("map_snr"), (std::vector<std::string>{"north", "east"}));
  EXPECT_EQ(file.read("north"), (std::vector<double>{-90.0, 10.0, 110.0}));
  EXPECT_EQ(file.read("map_snr")[2 * 3 + 1], 20.0);  // 100 m north
  EXPECT_EQ(file.read("source_frequency"), (std::vector<double>{17.5, 22.5, 27.5}));
}

}  // namespace
}  // namespace earshot::sonar
