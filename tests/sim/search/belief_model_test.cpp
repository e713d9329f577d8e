#include "sim/search/belief_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace earshot::search {
namespace {

TEST(BeliefModelOf, FitsItsCapacitiesInEveryArea) {
  const double sizes_m[][2] = {{25'000.0, 25'000.0}, {1'000.0, 1'000.0}, {100.0, 1'000'000.0}, {1'000'000.0, 100.0},
                               {3'000.0, 400'000.0}, {1e7, 1e7},         {1e7, 1.0},           {499.0, 37'123.0}};
  for (const auto& [north_m, east_m] : sizes_m) {
    SearchSettings settings;
    settings.domain = {{Meters{-500.0}, Meters{700.0}}, {Meters{-500.0 + north_m}, Meters{700.0 + east_m}}};
    const policy::BeliefModel model = belief_model(settings);
    EXPECT_TRUE(policy::has_valid_shape(model)) << north_m << " x " << east_m;
    EXPECT_TRUE(model.cells_north >= 1 && model.cells_east >= 1) << north_m << " x " << east_m;
    EXPECT_LE(std::size_t{model.cells_north} * model.cells_east, config::kMaxBeliefCells) << north_m << " x " << east_m;
    EXPECT_TRUE(policy::has_valid_numbers(model)) << north_m << " x " << east_m;
  }
}

TEST(BeliefModelOf, HasCellsOfFiveHundredMetresInThePapersArea) {
  const policy::BeliefModel model = belief_model(SearchSettings{});
  EXPECT_EQ(model.cells_north, 50);  // 25 km
  EXPECT_EQ(model.cells_east, 50);
}

TEST(BeliefModelOf, DividesEachSideOfAnAreaThatIsNotSquareByItself) {
  SearchSettings settings;
  settings.domain = {{Meters{-3'000.0}, Meters{7'000.0}}, {Meters{7'000.0}, Meters{37'000.0}}};  // 10 km north, 30 km east
  const policy::BeliefModel small = belief_model(settings);
  EXPECT_EQ(small.area_size, (NorthEast{Meters{10'000.0}, Meters{30'000.0}}));
  EXPECT_EQ(small.cells_north, 20);
  EXPECT_EQ(small.cells_east, 60);
  // 40 km north, 250 km east: 2500 cells of 2 km.
  settings.domain = {{Meters{0.0}, Meters{0.0}}, {Meters{40'000.0}, Meters{250'000.0}}};
  const policy::BeliefModel large = belief_model(settings);
  EXPECT_EQ(large.cells_north, 20);
  EXPECT_EQ(large.cells_east, 125);
}

TEST(BeliefModelOf, TakesStepThresholdDirectionsAndBorderFromTheSearch) {
  SearchSettings settings;
  settings.step_length = Meters{750.0};
  settings.detection_threshold = Decibels{7.0};
  settings.direction_count = 4;
  settings.border_width = Meters{300.0};
  const policy::BeliefModel model = belief_model(settings);
  EXPECT_EQ(model.step_length, Meters{750.0});
  EXPECT_EQ(model.detection_threshold, Decibels{7.0});
  ASSERT_EQ(model.actions.size(), 4U);
  EXPECT_EQ(model.actions[1], (UnitNorthEast{0.0, 1.0}));
  EXPECT_EQ(model.border_width, Meters{300.0});
}

TEST(BeliefModelOf, HasTheCostsThatFoundMost) {
  const policy::BeliefCosts costs = belief_model(SearchSettings{}).costs;
  EXPECT_EQ(costs.step, 10.0F);
  EXPECT_NEAR(std::exp(static_cast<double>(costs.log_step_discount)), 0.85, 1e-8);  // a float of 0.16 is good to 1e-8
  EXPECT_EQ(costs.find_probability, 100.0F);
}

TEST(BeliefModelOf, CostsAtTheEdgeWhatTheSearchTakesOffThere) {
  SearchSettings settings;
  EXPECT_EQ(belief_model(settings).costs.edge, 100.0F) << "the paper's p = -100";
  settings.border_reward = -40.5;
  EXPECT_EQ(belief_model(settings).costs.edge, 40.5F);
  settings.border_reward = 3.0;  // an edge that is rewarded costs nothing
  EXPECT_EQ(belief_model(settings).costs.edge, 0.0F);
}

}  // namespace
}  // namespace earshot::search
