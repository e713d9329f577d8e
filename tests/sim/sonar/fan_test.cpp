#include "sim/sonar/fan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <vector>

#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/horizontal_map.hpp"
#include "tests/sim/sonar/charted_ocean.hpp"
#include "tests/sim/sonar/hilly_ocean.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::sonar {
namespace {

/// Four bearings (north, east, south, west), ranges 100, 200, 300 m about (1000 m north, 2000 m east).
Fan by_hand() {
  return {.centre = {Meters{1000.0}, Meters{2000.0}},
          .bearings = 4,
          .ranges = 3,
          .range_step = Meters{100.0},
          .depth_m = {300.0},
          .transmission_loss_db = {60, 66, 70, 50, 52, 54, 80, 80, 80, 40, std::numeric_limits<float>::quiet_NaN(), 44},
          .sea_floor_depth_m = std::vector<float>(12, 3000.0F)};
}

double loss_at(double north_m, double east_m) {
  return by_hand().transmission_loss_at({Meters{1000.0 + north_m}, Meters{2000.0 + east_m}}, 0);
}

TEST(Fan, IsLinearInDecibelsBetweenItsRadialsAndRanges) {
  EXPECT_NEAR(loss_at(150.0, 0.0), 63.0, 1e-9);
  EXPECT_NEAR(loss_at(0.0, 300.0), 54.0, 1e-9);
  EXPECT_NEAR(loss_at(100.0, 100.0), (60 + 6 * 0.41421356 + 50 + 2 * 0.41421356) / 2, 1e-6);  // north-east, at 141.4 m
  EXPECT_NEAR(loss_at(-100.0 * std::sin(0.3), 100.0 * std::cos(0.3)), 50 + (80 - 50) * 0.3 / 1.57079633, 1e-6);
}

TEST(Fan, GoesRoundFromItsLastRadialToItsFirst) {
  EXPECT_NEAR(loss_at(100.0 * std::sin(0.5), -100.0 * std::cos(0.5)), 40 + (60 - 40) * 0.5 / 1.57079633, 1e-6);
  EXPECT_NEAR(loss_at(200.0, -1e-9), 66.0, 1e-6);
}

TEST(Fan, HoldsItsNearestLossInsideTheFirstRange) {
  EXPECT_EQ(loss_at(0.0, 30.0), 50.0);
}

TEST(Fan, KnowsNothingBeyondItsLastRangeNorBesideWhatHasNoWater) {
  EXPECT_TRUE(std::isnan(loss_at(301.0, 0.0)));
  EXPECT_TRUE(std::isnan(loss_at(0.0, -150.0)));
  EXPECT_TRUE(std::isnan(loss_at(0.0, -200.0)));
  EXPECT_TRUE(std::isnan(loss_at(0.0, -250.0)));                                     // behind it
  EXPECT_TRUE(std::isnan(loss_at(200.0 * std::sin(0.5), -200.0 * std::cos(0.5))));   // clockwise of it
  EXPECT_TRUE(std::isnan(loss_at(-200.0 * std::sin(0.5), -200.0 * std::cos(0.5))));  // and the other way
  EXPECT_NEAR(loss_at(0.0, -100.0), 40.0, 1e-6);                                     // on the last range before
  EXPECT_TRUE(std::isnan(loss_at(std::nan(""), 0.0)));
}

TEST(Fan, ReachesAsFarAsItsLastRange) {
  EXPECT_EQ(by_hand().max_range(), Meters{300.0});
}

TEST(Fan, HasSoundWhereAnyOfItsPlacesHasWater) {
  Fan fan = by_hand();
  EXPECT_TRUE(has_sound(fan));
  fan.transmission_loss_db.assign(12, std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(has_sound(fan));
  fan.transmission_loss_db[7] = 80.0F;
  EXPECT_TRUE(has_sound(fan));
}

TEST(Fan, KeepsEachDepthsLossApart) {
  const Fan fan{.centre = {},
                .bearings = 2,
                .ranges = 2,
                .range_step = Meters{100.0},
                .depth_m = {30.0, 100.0, 300.0},
                .transmission_loss_db = {60, 61, 62, 70, 71, 72, 80, 81, 82, 90, 91, 92},
                .sea_floor_depth_m = std::vector<float>(4, 3000.0F)};
  EXPECT_EQ(fan.at(1, 0, 2), 82.0F);
  EXPECT_NEAR(fan.transmission_loss_at({Meters{200.0}, Meters{0.0}}, 0), 70.0, 1e-9);
  EXPECT_NEAR(fan.transmission_loss_at({Meters{100.0}, Meters{0.0}}, 2), 62.0, 1e-9);
  EXPECT_NEAR(fan.transmission_loss_at({Meters{150.0}, Meters{0.0}}, 1), 66.0, 1e-9);
  EXPECT_NEAR(fan.transmission_loss_at({Meters{-200.0}, Meters{0.0}}, 1), 91.0, 1e-9);
}

TEST(Fan, RepeatsAllDepthsAndRangesOfItsFirstBearing) {
  Fan fan{.centre = {},
          .bearings = 3,
          .ranges = 2,
          .range_step = Meters{100.0},
          .depth_m = {30.0, 300.0},
          .transmission_loss_db = {60, 61, 70, 71, 0, 0, 0, 0, 0, 0, 0, 0},
          .sea_floor_depth_m = {500, 400, 0, 0, 0, 0}};
  repeat_first_bearing(fan);
  EXPECT_EQ(fan.transmission_loss_db, (std::vector<float>{60, 61, 70, 71, 60, 61, 70, 71, 60, 61, 70, 71}));
  EXPECT_EQ(fan.sea_floor_depth_m, (std::vector<float>{500, 400, 500, 400, 500, 400}));
}

TEST(Fan, FindsTheDeepestSeaFloorAndTheThickestUnmeasuredWaterOfAllItsBearings) {
  const ocean::Environment sea = tests::charted_ocean();
  const Meters half_a_degree = 0.5 * tests::kDegreeOfTheEquator;
  EXPECT_NEAR(deepest_sea_floor(sea, {}, 4, half_a_degree).value, 3500.0, 1e-4);  // in the east, the second of four
  EXPECT_NEAR(deepest_sea_floor(sea, {}, 1, half_a_degree).value, 3000.0, 1e-4);  // in the north alone
  const auto thickest = unmeasured_water(sea, {}, 4, half_a_degree);
  ASSERT_TRUE(thickest.has_value());
  EXPECT_EQ(thickest->data_end, Meters{1500.0});
  EXPECT_NEAR(thickest->thickness().value, 2000.0, 1e-4);
  EXPECT_NEAR(thickest->range.value, half_a_degree.value, 1e-6);
}

TEST(HorizontalMap, HasNorthInItsRowsAndEastInItsColumns) {
  const Detector detector{
      .source_level = Decibels{190.0}, .noise_level = Decibels{90.0}, .detection_threshold = Decibels{40.0}, .fluctuation = Decibels{0.0}};
  const HorizontalMap map = make_map(by_hand(), 0, {.side = Meters{400.0}, .intervals = 4}, detector);
  ASSERT_EQ(map.snr_db.size(), 25U);
  EXPECT_EQ(map.north_m, (std::vector<double>{800, 900, 1000, 1100, 1200}));
  EXPECT_EQ(map.east_m, (std::vector<double>{1800, 1900, 2000, 2100, 2200}));
  EXPECT_NEAR(map.snr_db[4 * 5 + 2], 100 - 66, 1e-5);  // 200 m north; float
  EXPECT_NEAR(map.snr_db[2 * 5 + 3], 100 - 50, 1e-5);  // 100 m east
  EXPECT_EQ(map.detection_probability[4 * 5 + 2], 0.0F);
  EXPECT_EQ(map.detection_probability[2 * 5 + 3], 1.0F);
  EXPECT_TRUE(std::isnan(map.snr_db[2 * 5 + 0]));  // no water 200 m west
}

FanPlan plan(std::size_t bearings) {
  return {.bearings = bearings,
          .radial = {.source_depth = Meters{30.0},
                     .depth_m = {300.0},
                     .range_step = Meters{50.0},
                     .ranges = 160,
                     .band = {Hertz{20.0}, Hertz{20.0}},
                     .options = {.accuracy = Decibels{0.1}}}};
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Fan, IsTheSameBitForBitForEveryNumberOfThreads) {
  const support::TemporaryFolder folder;
  const auto environment = ocean::load_environment(tests::write_hilly_ocean(folder.path()));
  const Fan one = compute_fan(environment, {}, plan(8), 1);
  EXPECT_TRUE(same_bits(one.transmission_loss_db, compute_fan(environment, {}, plan(8), 2).transmission_loss_db));
  EXPECT_TRUE(same_bits(one.transmission_loss_db, compute_fan(environment, {}, plan(8), 5).transmission_loss_db));
}

TEST(Fan, HasOneLossOnEveryBearingOfAnOceanThatDoesNotDifferWithPlace) {
  const auto environment = ocean::load_environment(std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml");
  ASSERT_FALSE(differs_with_place(environment));
  const Fan fan = compute_fan(environment, {}, plan(6), 2);
  for (std::size_t i = 0; i < fan.ranges; ++i) ASSERT_EQ(fan.at(5, i, 0), fan.at(0, i, 0));
  EXPECT_EQ(fan.sea_floor_depth_m.back(), 3000.0F);
}

TEST(Fan, KnowsTheLargestErrorOfItsBearings) {
  Fan fan = by_hand();
  EXPECT_FALSE(grid_of(fan)) << "of a fan that was read nothing is known";
  EXPECT_FALSE(doubt_of(fan, Decibels{0.02}));
  fan.grid = {pe::MarchGrid{Meters{2.0}, Meters{40.0}, 5, 0.01, 0.08}, std::nullopt, pe::MarchGrid{Meters{1.0}, Meters{50.0}, 4, 3.5, 0.08},
              pe::MarchGrid{Meters{3.0}, Meters{60.0}, 8, 0.02, 0.08}};
  const auto grid = grid_of(fan);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->depth_step, Meters{1.0});
  EXPECT_EQ(grid->range_step, Meters{40.0});
  EXPECT_EQ(grid->terms, 8U);
  EXPECT_EQ(grid->predicted_error_db, 3.5);
  EXPECT_NE(doubt_of(fan, Decibels{0.02}).value_or("").find("predicted to be 3.5 dB"), std::string::npos);
  EXPECT_FALSE(doubt_of(fan, Decibels{3.0})) << "it is little more than was asked for";
}

TEST(Fan, HasTheGridOfEachOfItsMarches) {
  const support::TemporaryFolder folder;
  FanPlan short_plan = plan(4);
  short_plan.radial.ranges = 1;
  const auto hills = ocean::load_environment(tests::write_hilly_ocean(folder.path()));
  const Fan fan = compute_fan(hills, {}, short_plan, 2);
  ASSERT_EQ(fan.grid.size(), 4U);
  for (const auto& grid : fan.grid) {
    ASSERT_TRUE(grid);
    EXPECT_LE(grid->predicted_error_db, 0.1);
  }
  const auto flat = ocean::load_environment(std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml");
  EXPECT_TRUE(compute_fan(flat, {}, short_plan, 2).grid.back()) << "one march is that of all bearings";
}

TEST(Fan, SaysWithinEachBearingHowMuchIsDone) {
  FanPlan short_plan = plan(4);
  short_plan.radial.ranges = 20;
  const support::TemporaryFolder folder;
  const auto hills = ocean::load_environment(tests::write_hilly_ocean(folder.path()));
  std::vector<double> done;
  (void)compute_fan(hills, {}, short_plan, 2, [&](double share) { done.push_back(share); });
  EXPECT_TRUE(std::ranges::is_sorted(done));
  for (const double share : {0.25, 0.5, 0.75, 1.0})
    EXPECT_TRUE(std::ranges::any_of(done, [share](double reported) { return reported >= share; })) << share;
  EXPECT_GT(done.size(), 4U);  // also within a bearing: one may take minutes
  EXPECT_EQ(done.back(), 1.0);
  done.clear();
  short_plan.radial.source_depth = Meters{5000.0};  // in the sea floor: no bearing is ever done
  EXPECT_THROW((void)compute_fan(hills, {}, short_plan, 2, [&](double share) { done.push_back(share); }), std::invalid_argument);
  EXPECT_TRUE(done.empty());
}

TEST(Fan, LooksEastAlongItsBearingOfNinetyDegrees) {
  const support::TemporaryFolder folder;
  const auto environment = ocean::load_environment(tests::write_hilly_ocean(folder.path()));
  const Fan fan = compute_fan(environment, {}, plan(4), 2);
  const auto floor = [&](std::size_t bearing, std::size_t range) { return fan.sea_floor_depth_m[bearing * fan.ranges + range]; };
  EXPECT_EQ(floor(1, 159), 0.0F);  // the island stands in the east
  EXPECT_TRUE(std::isnan(fan.at(1, 159, 0)));
  EXPECT_GT(floor(3, 159), 2000.0F);
  EXPECT_FALSE(std::isnan(fan.at(3, 159, 0)));
  EXPECT_FALSE(std::isnan(fan.at(1, 40, 0)));
}

TEST(Fan, MirrorsAnOceanThatIsMirrored) {
  const support::TemporaryFolder folder;
  const auto environment = ocean::load_environment(tests::write_hilly_ocean(folder.path()));  // symmetric about the equator
  const Fan fan = compute_fan(environment, {}, plan(8), 2);
  for (std::size_t i = 0; i < fan.ranges; ++i) {
    if (std::isnan(fan.at(1, i, 0))) continue;
    ASSERT_NEAR(fan.at(1, i, 0), fan.at(3, i, 0), 0.01) << i;  // north-east and south-east: geodesics round differently, minima magnify it
  }
}

}  // namespace
}  // namespace earshot::sonar
