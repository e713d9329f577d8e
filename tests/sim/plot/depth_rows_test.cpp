#include "sim/plot/depth_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace earshot::plot {
namespace {

constexpr float kNoWater = std::numeric_limits<float>::quiet_NaN();

TEST(DepthRows, ShowEachDepthWhereItIsThoughTheDepthsLieUnequallyFarApart) {
  const DepthRows rows = depth_rows(std::array{10.0, 20.0, 100.0}, 140);  // from the surface to 100 + 80 / 2 m: a row a metre
  ASSERT_EQ(rows.depth_m.size(), 140U);
  EXPECT_NEAR(rows.depth_m.front(), 0.5, 1e-9);
  EXPECT_NEAR(rows.depth_m.back(), 139.5, 1e-9);
  for (std::size_t row = 0; row < rows.depth_m.size(); ++row) {
    const std::size_t nearest = rows.depth_m[row] < 15.0 ? 0U : rows.depth_m[row] < 60.0 ? 1U : 2U;
    EXPECT_EQ(rows.of_field[row], nearest) << rows.depth_m[row] << " m";
  }
}

TEST(DepthRows, LeaveOutTheWaterThatTheDepthsDoNotSpeakOf) {
  const DepthRows rows = depth_rows(std::array{200.0, 220.0, 240.0}, 60);
  EXPECT_NEAR(rows.depth_m.front(), 190.5, 1e-9);
  EXPECT_NEAR(rows.depth_m.back(), 249.5, 1e-9);
}

TEST(DepthRows, GoDownToTheSeaFloorWithTheDeepestWaterAboveIt) {
  const sonar::SonarField field{.range_m = {100.0, 200.0, 300.0},
                                .depth_m = {10.0, 20.0, 30.0},
                                .source_level = Decibels{100.0},
                                .noise_level = Decibels{40.0},
                                .transmission_loss_db = {50, 51, 52, 53, kNoWater, kNoWater, kNoWater, kNoWater, kNoWater},
                                .sea_floor_depth_m = {35.0F, 17.0F, 0.0F}};
  EXPECT_EQ(snr_to_draw(field, 0, 2), 8.0F) << "100 - 52 - 40";
  EXPECT_EQ(snr_to_draw(field, 1, 2), 7.0F) << "of 10 m, the deepest water above a sea floor at 17 m";
  EXPECT_TRUE(std::isnan(snr_to_draw(field, 2, 2))) << "land";
}

}  // namespace
}  // namespace earshot::plot
