#include "policy/baselines/space_aware_cost.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace earshot::baselines {
namespace {

TEST(SpaceAwareCost, IsThatOfTheEquation) {
  EXPECT_EQ(space_aware_cost(1.0, 0.0), 0.0);                      // log2(1 + 2^-1 - 1/2)
  EXPECT_EQ(space_aware_cost(8.0, 0.0), 3.0);                      // log2(8)
  EXPECT_DOUBLE_EQ(space_aware_cost(3.0, 3.0), std::log2(4.5));    // H' = 2: log2(3 + 2 - 1/2)
  EXPECT_DOUBLE_EQ(space_aware_cost(12.5, 6.0), 4.8073549220576);  // H' = 5: log2(12.5 + 16 - 1/2) = log2(28)
}

TEST(SpaceAwareCost, OfTwoPlacesThatOneStepClearsIsThatOfOne) {
  EXPECT_EQ(space_aware_cost(2.0, 1.0), space_aware_cost(2.0, 0.0));
  EXPECT_GT(space_aware_cost(2.0, 1.5), space_aware_cost(2.0, 0.0));
}

TEST(SpaceAwareCost, IsExpectedToBeNothingWhereTheSourceIsFound) {
  // One place three steps away, whatever is heard: a half, a quarter; found in the last quarter.
  EXPECT_DOUBLE_EQ(expected_space_aware_cost(std::vector<float>{0.5F, 0.25F}, std::vector<float>{3.0F}), 0.75 * std::log2(3.0));
}

/// Four places, two outcomes. The first, of 5/8, leaves four places that are as likely as 2 : 1 : 1 : 1, the second one alone.
TEST(SpaceAwareCost, OfAStepIsTheMeanOverWhatMayBeHeard) {
  const std::vector<float> joint{0.25F, 0.0F, 0.125F, 0.0F, 0.125F, 0.0F, 0.125F, 0.25F};
  const std::vector<float> distance_steps{1.0F, 2.0F, 4.0F, 8.0F};
  // First: D = (2 * 1 + 2 + 4 + 8) / 5 = 3.2; H = 2/5 log2(5/2) + 3/5 log2(5) = 1.921928 bit; log2(3.2 + 2^-0.078072 - 0.5) = 1.866838.
  // Second: D = 8, H = 0; log2(8) = 3. The rest, 1/8, is found.
  EXPECT_NEAR(expected_space_aware_cost(joint, distance_steps), 0.625 * 1.866838 + 0.25 * 3.0, 1e-6);
}

/// What is to be found out is worth a detour: the same four places, and a measurement that tells two of them from the other two or tells
/// nothing.
TEST(SpaceAwareCost, IsLessWhereAMeasurementTellsMore) {
  const std::vector<float> distance_steps{6.0F, 6.0F, 6.0F, 6.0F};
  const std::vector<float> learning{0.25F, 0.0F, 0.25F, 0.0F, 0.0F, 0.25F, 0.0F, 0.25F};
  const std::vector<float> nothing_learnt{0.125F, 0.125F, 0.125F, 0.125F, 0.125F, 0.125F, 0.125F, 0.125F};
  EXPECT_NEAR(expected_space_aware_cost(learning, distance_steps), std::log2(6.0), 1e-12);
  EXPECT_NEAR(expected_space_aware_cost(nothing_learnt, distance_steps), std::log2(6.5), 1e-12);
}

}  // namespace
}  // namespace earshot::baselines
