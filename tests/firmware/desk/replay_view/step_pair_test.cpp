#include "firmware/desk/replay_view/step_pair.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/firmware/desk/replay_view/known_decisions.hpp"

namespace earshot::replay_view {
namespace {

TEST(StepPair, PartsWhereTheVehicleIsSentElsewhereOrAtAnotherTimeOrNotAtAll) {
  const messages::Decision then = decision_to(0, 2, 13'000, 12'000);
  const auto is_same_as = [&](const messages::Decision& now) { return StepPair{.step = 0, .then = then, .now = now}.is_same(); };
  EXPECT_TRUE(is_same_as(then));
  messages::Decision other_thoughts = then;
  other_thoughts.logits[0] = 3;
  other_thoughts.action = 5;
  EXPECT_TRUE(is_same_as(other_thoughts)) << "another policy counts its actions otherwise";
  EXPECT_FALSE(is_same_as(decision_to(0, 3, 13'000, 12'000)));
  EXPECT_FALSE(is_same_as(decision_to(0, 2, 13'000.000001, 12'000)));
  EXPECT_FALSE(is_same_as(decision_to(0, 2, 13'000, 11'999)));
  EXPECT_FALSE((StepPair{.step = 0, .then = then, .now = {}}.is_same()));
}

TEST(StepPair, PairsByStepAndFindsTheFirstPartingOfAllAndOfThoseFromAStepOn) {
  const std::array then{decision_to(0, 2, 1, 1), decision_to(1, 500, 2, 2), decision_to(2, 1000, 3, 3)};
  const std::array now{decision_to(0, 2, 9, 1), decision_to(1, 500, 2, 2), decision_to(2, 1000, 3, 9), decision_to(3, 1500, 4, 4)};
  const std::vector<StepPair> all = paired(then, now);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(parting(all), &all[0]);
  EXPECT_FALSE(all[3].then);
  const std::span<const StepPair> later = from(1, all);
  ASSERT_EQ(later.size(), 3U);
  EXPECT_EQ(later.front().step, 1U);
  EXPECT_EQ(parting(later)->step, 2U);
  EXPECT_EQ(parting(later.first(1)), nullptr);
  EXPECT_TRUE(from(4, all).empty());
}

}  // namespace
}  // namespace earshot::replay_view
