#include "sim/search/reward/step_reward.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/place.hpp"

namespace earshot::search {
namespace {

constexpr Decibels kHeard{10.0};  // the threshold itself counts as detected
constexpr Decibels kUnheard{9.99};

TEST(StepReward, IsZeroOnADetectionAndMinusOneWithoutInTheInterior) {
  const SearchSettings paper;
  EXPECT_EQ(step_reward(paper, at(12'000, 12'000), kHeard), 0.0);
  EXPECT_EQ(step_reward(paper, at(12'000, 12'000), kUnheard), -1.0);
}

TEST(StepReward, TakesAHundredAtTheEdgeAndHalfOfItHalfwayThroughTheBorder) {
  const SearchSettings paper;
  EXPECT_EQ(step_reward(paper, at(12'000, 0), kHeard), -100.0);
  EXPECT_EQ(step_reward(paper, at(24'500, 12'000), kHeard), -50.0);
  EXPECT_EQ(step_reward(paper, at(24'500, 12'000), kUnheard), -51.0);
}

TEST(StepReward, IsFreeOfPenaltyExactlyAtTheInnerEdgeOfTheBorder) {
  EXPECT_EQ(step_reward({}, at(1'000, 12'000), kHeard), 0.0);
}

TEST(StepReward, GrowsBeyondTheEdgePenaltyOutside) {
  EXPECT_EQ(step_reward({}, at(25'500, 12'000), kUnheard), -151.0);
}

TEST(StepReward, CountsANearCornerOnceByItsNearestEdge) {
  EXPECT_EQ(step_reward({}, at(250, 500), kHeard), -75.0);
}

}  // namespace
}  // namespace earshot::search
