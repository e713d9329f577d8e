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
