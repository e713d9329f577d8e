#include "sim/search/belief_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace earshot::search {
namespace {

TEST(BeliefModelOf, FitsItsCapacitiesAndReachesTheDiagonalOfEveryArea) {
  const sonar::SnrCurve curve(Meters{10.0}, {30.0F, 20.0F});
  const double sizes_m[][2] = {{25'000.0, 25'000.0}, {1'000.0, 1'000.0}, {100.0, 1'000'000.0}, {1'000'000.0, 100.0},
                               {3'000.0, 400'000.0}, {1e7, 1e7},         {1e7, 1.0},           {499.0, 37'123.0}};
  for (const auto& [north_m, east_m] : sizes_m) {
    SearchSettings settings;
    settings.domain = {{Meters{-500.0}, Meters{700.0}}, {Meters{-500.0 + north_m}, Meters{700.0 + east_m}}};
    const policy::BeliefModel model = belief_model(settings, curve);
    EXPECT_TRUE(policy::has_valid_shape(model)) << north_m << " x " << east_m;
    EXPECT_TRUE(model.cells_north >= 1 && model.cells_east >= 1) << north_m << " x " << east_m;
    EXPECT_LE(std::size_t{model.cells_north} * model.cells_east, config::kMaxBeliefCells) << north_m << " x " << east_m;
    EXPECT_LE(model.snr_db.size(), config::kMaxBeliefRanges) << north_m << " x " << east_m;
    const double last_m = static_cast<double>(model.snr_db.size() - 1) * model.range_step.value;
    EXPECT_GE(last_m, (1.0 - 1e-9) * std::hypot(north_m, east_m)) << north_m << " x " << east_m;  // rounding of the last step
  }
}

TEST(BeliefModelOf, HasCellsOfFiveHundredMetresAndRangesOfAHundredInThePapersArea) {
  const policy::BeliefModel model = belief_model(SearchSettings{}, sonar::SnrCurve(Meters{10.0}, {30.0F, 20.0F}));
  EXPECT_EQ(model.cells_north, 50);  // 25 km
  EXPECT_EQ(model.cells_east, 50);
  EXPECT_EQ(model.range_step, Meters{100.0});
}

TEST(BeliefModelOf, DividesEachSideOfAnAreaThatIsNotSquareByItself) {
  SearchSettings settings;
  settings.domain = {{Meters{-3'000.0}, Meters{7'000.0}}, {Meters{7'000.0}, Meters{37'000.0}}};  // 10 km north, 30 km east
  const policy::BeliefModel small = belief_model(settings, sonar::SnrCurve(Meters{10.0}, {30.0F, 20.0F}));
  EXPECT_EQ(small.area_size, (NorthEast{Meters{10'000.0}, Meters{30'000.0}}));
  EXPECT_EQ(small.cells_north, 20);
  EXPECT_EQ(small.cells_east, 60);
  // 40 km north, 250 km east: 2500 cells of 2 km. Its diagonal of 253 180 m has 510 steps of 496.43 m.
  settings.domain = {{Meters{0.0}, Meters{0.0}}, {Meters{40'000.0}, Meters{250'000.0}}};
  const policy::BeliefModel large = belief_model(settings, sonar::SnrCurve(Meters{10.0}, {30.0F, 20.0F}));
  EXPECT_EQ(large.cells_north, 20);
  EXPECT_EQ(large.cells_east, 125);
  EXPECT_NEAR(large.range_step.value, 496.431, 1e-3);  // as printed above
  EXPECT_EQ(large.snr_db.size(), 512U);
}

TEST(BeliefModelOf, SamplesItsOceansCurveFromTheSourceToJustBeyondTheDiagonal) {
  SearchSettings settings;
  settings.domain = {{Meters{0.0}, Meters{0.0}}, {Meters{3'000.0}, Meters{4'000.0}}};
  std::vector<float> snr_db;
  for (int i = 0; i <= 100; ++i) snr_db.push_back(40.0F - static_cast<float>(i));  // a decibel every 100 m
  const policy::BeliefModel model = belief_model(settings, sonar::SnrCurve(Meters{100.0}, snr_db));
  ASSERT_EQ(model.snr_db.size(), 52U);  // 0 m to 5000 m, and one more
  for (std::size_t i = 0; i < 52; ++i) EXPECT_EQ(model.snr_db[i], 40.0F - static_cast<float>(i)) << i;
}

TEST(BeliefModelOf, TakesStepThresholdDirectionsAndBorderFromTheSearch) {
  SearchSettings settings;
  settings.step_length = Meters{750.0};
  settings.detection_threshold = Decibels{7.0};
  settings.direction_count = 4;
  settings.border_width = Meters{300.0};
  const policy::BeliefModel model = belief_model(settings, sonar::SnrCurve(Meters{10.0}, {30.0F, 20.0F}));
  EXPECT_EQ(model.step_length, Meters{750.0});
  EXPECT_EQ(model.detection_threshold, Decibels{7.0});
  ASSERT_EQ(model.actions.size(), 4U);
  EXPECT_EQ(model.actions[1], (UnitNorthEast{0.0, 1.0}));
  EXPECT_EQ(model.border_width, Meters{300.0});
}

TEST(BeliefModelOf, HoldsTheOceanAsKnownTwiceAsLikelyAsOneSixDecibelsOff) {
  const policy::BeliefModel model = belief_model(SearchSettings{}, sonar::SnrCurve(Meters{10.0}, {30.0F, 20.0F}));
  ASSERT_EQ(model.hypotheses.size(), 4U);
  const auto expect = [&](std::size_t i, float level_offset_db, float spread_db, float prior) {
    EXPECT_EQ(model.hypotheses[i].level_offset_db, level_offset_db) << i;
    EXPECT_EQ(model.hypotheses[i].spread_db, spread_db) << i;
    EXPECT_EQ(model.hypotheses[i].prior, prior) << i;
  };
  expect(0, 0.0F, 1.0F, 2.0F);  // just as the curve has it
  expect(1, 0.0F, 4.0F, 2.0F);  // as loud, in rougher water
  expect(2, -6.0F, 4.0F, 1.0F);
  expect(3, 6.0F, 4.0F, 1.0F);
}

TEST(BeliefModelOf, CostsAtTheEdgeWhatTheSearchTakesOffThere) {
  const sonar::SnrCurve curve(Meters{10.0}, {30.0F, 20.0F});
  SearchSettings settings;
  EXPECT_EQ(belief_model(settings, curve).costs.edge, 100.0F) << "the paper's p = -100";
  settings.border_reward = -40.5;
  EXPECT_EQ(belief_model(settings, curve).costs.edge, 40.5F);
  settings.border_reward = 3.0;  // an edge that is rewarded costs nothing
  EXPECT_EQ(belief_model(settings, curve).costs.edge, 0.0F);
}

}  // namespace
}  // namespace earshot::search
