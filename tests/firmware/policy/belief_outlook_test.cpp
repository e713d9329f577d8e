#include "firmware/policy/belief_outlook.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/firmware/policy/belief_rig.hpp"

namespace earshot::policy {
namespace {

/// A belief that knows the source to the cell, as heard from afar.
class OutlookTest : public BeliefTest {
 protected:
  /// Looks at the source from afar, then once from `place`.
  void know(NorthEast source, NorthEast place) {
    belief->start(model);
    for (const NorthEast from : {at(1'000, 10'500), at(19'000, 9'500), at(10'000, 1'000), at(10'000, 19'000), place}) {
      hear(model, from, snr_at(from, source));
    }
  }

  BeliefModel model = flat_model({{0.0F, 0.2F, 1.0F}});
};

TEST_F(OutlookTest, HasNoRegretForTheStraightWayToTheSource) {
  know(centre(30, 20), centre(10, 20));
  EXPECT_EQ(belief->outlook(kNorth).regret, 0.0F);
  EXPECT_GT(belief->outlook(kEast).regret, 0.1F);
  EXPECT_GT(belief->outlook(kSouth).regret, belief->outlook(kEast).regret);
}

TEST_F(OutlookTest, FindsWhereAStepEndsWithinReachOfTheSource) {
  know(centre(23, 20), centre(20, 20));  // 1500 m north: one step leaves 500 m
  EXPECT_GT(belief->outlook(kNorth).found, 0.95F);
  EXPECT_LT(belief->outlook(kSouth).found, 0.05F);
}

TEST_F(OutlookTest, ReachesInTwoStepsWhatOneDoesNot) {
  know(centre(23, 23), centre(20, 20));  // 1500 m north and 1500 m east
  EXPECT_LT(belief->outlook(kNorth).found, 0.2F);
  EXPECT_NEAR(belief->outlook(kNorth).reach, 0.85F * 0.95F, 0.06F);  // the second step counts 0.85
  EXPECT_EQ(belief->outlook(kNorth).reach, belief->outlook(kEast).reach);
}

/// Pythagoras by hand; the source lies far from the border, so that the way to it is the distance.
TEST(FindOutlooks, CostsWhatTheTablesSayAtTheRangesOfASourceThatIsKnown) {
  BeliefModel model = flat_model({{0.0F, 1.0F, 1.0F}});
  model.costs.reach = 1e-3F;
  std::vector<float> probabilities(std::size_t{40} * 40);
  probabilities[20 * 40 + 20] = 1.0F;
  std::vector<float> cost(300);
  std::vector<float> detected(300);
  for (std::size_t i = 0; i < 300; ++i) {
    cost[i] = static_cast<float>(i) * 0.01F;  // 0.1 a kilometre
    detected[i] = i < 60 ? 1.0F : 0.0F;       // within 6 km
  }
  std::array<ActionOutlook, 4> outlooks;
  find_outlooks(model, probabilities, {cost, detected}, centre(8, 20), outlooks);  // 6 km south of it
  EXPECT_NEAR(outlooks[kSouth].regret, 0.2F, 1e-5F);                               // 7 km of way instead of 5
  EXPECT_NEAR(outlooks[kEast].regret, 0.1F * (std::sqrt(37.0F) - 5.0F), 1e-4F);    // linear between ranges 100 m apart
  EXPECT_EQ(outlooks[kNorth].regret, 0.0F);
  EXPECT_EQ(outlooks[kNorth].detected, 1.0F);
  EXPECT_EQ(outlooks[kSouth].detected, 0.0F);
  EXPECT_EQ(outlooks[kNorth].found, 0.0F);
  EXPECT_EQ(outlooks[kNorth].reach, 0.0F);
}

TEST_F(OutlookTest, GoesAlongTheBorderForASourceBehindIt) {
  const NorthEast source = centre(30, 39);  // 250 m from the east edge, within the border
  know(source, at(15'250, 18'500));         // 1250 m west of it: one step east would find it 500 m deep in the border
  EXPECT_NEAR(belief->outlook(kEast).border, 0.5F, 1e-3F);
  EXPECT_GT(belief->outlook(kEast).regret, 5.0F);
}

TEST_F(OutlookTest, ExpectsADetectionWithinTwentyKilometres) {
  model.detection_threshold = Decibels{25.0};  // within 5 km
  know(centre(20, 20), at(10'250, 4'250));     // 6 km west
  EXPECT_GT(belief->outlook(kEast).detected, 0.4F);
  EXPECT_LT(belief->outlook(kNorth).detected, 0.1F);
}

TEST_F(OutlookTest, FindsNothingNearAPlaceBeyondWhatAFloatHolds) {
  belief->start(model);
  for (const NorthEast place : {at(1e300, 1e300), at(-1e300, 5'000), at(5'000, 1e300)}) {
    hear(model, place, 20.0);
    for (std::size_t action = 0; action < 4; ++action) EXPECT_EQ(belief->outlook(action).found, 0.0F);
  }
}

}  // namespace
}  // namespace earshot::policy
