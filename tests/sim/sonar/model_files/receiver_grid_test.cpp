#include "sim/sonar/model_files/receiver_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace earshot::sonar::model_files {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// 100 m of water over sand; a twelfth of its wavelength is 1.25 m.
ocean::Environment shallow() {
  return {.name = "shallow",
          .water = ocean::TabulatedProfile{.depth_m = {0.0, 100.0}, .sound_speed_mps = {1500.0, 1500.0}},
          .seabed = {.depth = Meters{100.0}, .layers = {{.thickness = Meters{}, .sound_speed = MetersPerSecond{1700.0}}}},
          .source = {.frequency = Hertz{100.0}, .level = {}, .depth = Meters{30.0}, .position = {}},
          .noise_level = {}};
}

RadialRequest covering(const ReceiverGrid& grid) {
  RadialRequest request{.band = {Hertz{100.0}, Hertz{100.0}}};
  cover(grid, shallow(), Radians{}, request);
  return request;
}

TEST(ReceiverGrid, IsCoveredByTheLongestStepThatAllItsRangesAreMultiplesOf) {
  EXPECT_EQ(covering({.depth_m = {}, .range_m = {0.0, 100.0, 200.0, 300.0}}).output_step, Meters{100.0});
  const RadialRequest unequal = covering({.depth_m = {}, .range_m = {150.0, 250.0, 1000.0}});
  EXPECT_EQ(unequal.output_step, Meters{50.0});
  EXPECT_EQ(unequal.max_range, Meters{1000.0});
  EXPECT_NEAR(covering({.depth_m = {}, .range_m = {196.0, 215.6, 254.8}}).output_step->value, 19.6, 1e-12);
}

TEST(ReceiverGrid, IsCoveredByATwelfthOfAWavelengthWhereItsRangesHaveNoCommonStep) {
  const RadialRequest request = covering({.depth_m = {}, .range_m = {200.0, 219.6, 239.2, 1000.0}});  // 0.4 m
  EXPECT_EQ(request.output_step, Meters{1.25});
  EXPECT_EQ(request.max_range, Meters{1000.0});
}

TEST(ReceiverGrid, IsComputedWhereThereIsWater) {
  EXPECT_EQ(covering({.depth_m = {0.0, 20.0, 100.0, 101.0}, .range_m = {}}).depth_m, (std::vector<double>{20.0, 100.0}));
  EXPECT_THROW((void)covering({.depth_m = {0.0, 101.0}, .range_m = {}}), BadRequest);
}

/// Two ranges and depths whose pressure, times the root of range, is 1 and i at the first depth.
SonarField two_by_two() {
  const double near = 1.0 / std::sqrt(100.0);
  const double far = 1.0 / std::sqrt(200.0);
  return {.range_m = {100.0, 200.0},
          .depth_m = {10.0, 50.0},
          .source_level = {},
          .noise_level = {},
          .transmission_loss_db = {20.0F, 40.0F, 23.0F, kNan},
          .sea_floor_depth_m = {60.0F, 40.0F},
          .pressure = {{near, 0.0}, {0.01, 0.0}, {0.0, far}, {kNan, kNan}}};
}

TEST(ReceiverGrid, HoldsTheFieldsOwnNumbersWhereTheFieldHasThem) {
  const SonarField at = at_receivers(two_by_two(), {.depth_m = {0.0, 10.0, 50.0, 70.0}, .range_m = {0.0, 100.0, 200.0}});
  ASSERT_EQ(at.transmission_loss_db.size(), 12U);
  for (std::size_t depth = 0; depth < 4; ++depth) EXPECT_TRUE(std::isnan(at.at(0, depth)));  // at the source
  EXPECT_EQ(at.at(1, 0), 300.0F);                                                            // at the surface
  EXPECT_EQ(at.pressure[4], std::complex<double>{});
  EXPECT_EQ(at.at(1, 1), 20.0F);
  EXPECT_EQ(at.pressure[5], two_by_two().pressure[0]);
  EXPECT_EQ(at.at(1, 2), 40.0F);
  EXPECT_TRUE(std::isnan(at.at(1, 3)));  // below all that was computed
  EXPECT_TRUE(std::isnan(at.at(2, 2)));  // below the sea floor there
}

TEST(ReceiverGrid, IsLinearInPressureWithoutItsSpreadingBetweenTwoRanges) {
  const SonarField at = at_receivers(two_by_two(), {.depth_m = {10.0, 50.0}, .range_m = {150.0}});
  // (1 + i) / 2 / sqrt(150): |p|^2 = 1 / 300.
  EXPECT_NEAR(at.pressure[0].real(), 0.5 / std::sqrt(150.0), 1e-15);
  EXPECT_NEAR(at.at(0, 0), 24.7712F, 1e-4F);
  EXPECT_TRUE(std::isnan(at.at(0, 1)));
  EXPECT_EQ(at.sea_floor_depth_m[0], 50.0F);
}

TEST(ReceiverGrid, IsLinearInDecibelsBetweenTwoRangesOfABand) {
  SonarField band = two_by_two();
  band.pressure.clear();
  EXPECT_NEAR(at_receivers(band, {.depth_m = {10.0}, .range_m = {150.0}}).at(0, 0), 21.5F, 1e-5F);
}

}  // namespace
}  // namespace earshot::sonar::model_files
