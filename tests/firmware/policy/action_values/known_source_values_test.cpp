// What actions promise to a vehicle that knows where the source is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "firmware/policy/action_values/action_values.hpp"
#include "tests/firmware/policy/action_values/action_values_rig.hpp"

namespace earshot::policy {
namespace {

/// A belief that knows the source to the cell, of 20 km x 20 km in cells of 500 m; a detection is certain within 20 km, and there is none
/// beyond.
class ActionValuesTest : public testing::Test {
 protected:
  void know(std::size_t north, std::size_t east, NorthEast place) {
    std::vector<float> probabilities(std::size_t{40} * 40);
    probabilities[40 * north + east] = 1.0F;
    std::vector<float> detected(300, 1.0F);
    std::fill(detected.begin() + 200, detected.end(), 0.0F);
    std::vector<float> cost(300);
    find_search_cost(model, kRangeStep, 1.0F, detected, cost);
    find_action_values(model, probabilities, {samples_of(cost, detected), kRangeStep}, place, action_values);
  }

  BeliefModel model = bare_model(at(20'000, 20'000), 40, 40);
  std::array<ActionValues, 4> action_values;
};

TEST_F(ActionValuesTest, HasNoRegretForTheStraightWayToTheSource) {
  know(30, 20, centre(10, 20));
  EXPECT_EQ(action_values[kNorth].regret, 0.0F);
  EXPECT_GT(action_values[kEast].regret, 0.1F);
  EXPECT_GT(action_values[kSouth].regret, action_values[kEast].regret);
}

TEST_F(ActionValuesTest, FindsWhereAStepEndsNearTheSource) {
  know(23, 20, centre(20, 20));  // 1500 m north: one step leaves 500 m
  EXPECT_EQ(action_values[kNorth].found, 1.0F);
  EXPECT_EQ(action_values[kSouth].found, 0.0F);
}

TEST_F(ActionValuesTest, FindsInTwoStepsWhatOneDoesNot) {
  know(23, 23, centre(20, 20));  // 1500 m north and 1500 m east
  EXPECT_EQ(action_values[kNorth].found, 0.0F);
  EXPECT_FLOAT_EQ(action_values[kNorth].find_probability, 0.85F);  // the second step counts 0.85
  EXPECT_EQ(action_values[kNorth].find_probability, action_values[kEast].find_probability);
}

TEST_F(ActionValuesTest, GoesAlongTheBorderForASourceBehindIt) {
  // 250 m from the east edge, within the border, and 1250 m west of it: one step east would find it 500 m deep in the border.
  know(30, 39, at(15'250, 18'500));
  EXPECT_FLOAT_EQ(action_values[kEast].border, 0.5F);
  EXPECT_GT(action_values[kEast].regret, 5.0F);
}

TEST_F(ActionValuesTest, ExpectsADetectionWhereTheTableHasOne) {
  know(20, 39, at(10'250, -850));  // 20.6 km west
  EXPECT_EQ(action_values[kEast].detected, 1.0F);
  EXPECT_EQ(action_values[kNorth].detected, 0.0F);
}

TEST_F(ActionValuesTest, FindsNothingNearAPlaceBeyondWhatAFloatHolds) {
  for (const NorthEast place : {at(1e300, 1e300), at(-1e300, 5'000), at(5'000, 1e300)}) {
    know(20, 20, place);
    for (const ActionValues& values : action_values) EXPECT_EQ(values.found, 0.0F);
  }
}

}  // namespace
}  // namespace earshot::policy
