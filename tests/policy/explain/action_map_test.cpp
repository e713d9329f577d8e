#include "policy/explain/action_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "policy/explain/replay.hpp"
#include "tests/policy/explain/flown_policy.hpp"

namespace earshot::explain {
namespace {

policy::Reception nothing(NorthEast) {
  return {.snr = Decibels{0.0}};
}

TEST(ActionMap, RunsFromTheSouthWestCornerInRowsFromWestToEast) {
  const ActionMap map = after_a_first_measurement(*place_policy(1), falling_ocean(), 5, nothing);
  ASSERT_EQ(map.size(), 25U);
  EXPECT_EQ(map.front().place, (NorthEast{Meters{2'500.0}, Meters{2'500.0}}));
  EXPECT_EQ(map[1].place, (NorthEast{Meters{2'500.0}, Meters{7'500.0}}));
  EXPECT_EQ(map.back().place, (NorthEast{Meters{22'500.0}, Meters{22'500.0}}));
}

TEST(ActionMap, PointsWhereThePolicyGoes) {
  const auto policy = place_policy(1);
  std::ranges::fill(policy->network.layer(2).packed, 0.0F);
  std::ranges::fill(policy->network.layer(2).bias, 0.0F);
  policy->network.layer(2).bias[2] = 20.0F;  // east, almost surely
  for (const MapPoint& point : after_a_first_measurement(*policy, falling_ocean(), 3, nothing)) {
    EXPECT_EQ(point.likeliest, 2U);
    EXPECT_NEAR(point.agreement, 1.0, 1e-6);
    EXPECT_NEAR(point.heading.east, 1.0, 1e-6);
  }
}

TEST(ActionMap, ShowsThatDirectionsWhichCancelOutDoNotAgree) {
  const auto policy = place_policy(1);
  std::ranges::fill(policy->network.layer(2).packed, 0.0F);
  std::ranges::fill(policy->network.layer(2).bias, 0.0F);
  policy->network.layer(2).bias[0] = policy->network.layer(2).bias[4] = 20.0F;  // north or south
  for (const MapPoint& point : after_a_first_measurement(*policy, falling_ocean(), 2, nothing)) EXPECT_NEAR(point.agreement, 0.0, 1e-6);
}

TEST(ActionMap, HearsAtEachPlaceWhatIsHeardThere) {
  const auto policy = belief_policy(3);
  const ActionMap quiet = after_a_first_measurement(*policy, falling_ocean(), 4, nothing);
  const ActionMap loud_in_the_north = after_a_first_measurement(*policy, falling_ocean(), 4, [](NorthEast place) {
    return policy::Reception{.snr = Decibels{place.north > Meters{12'500.0} ? 35.0 : 0.0}};
  });
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(quiet[i].probabilities, loud_in_the_north[i].probabilities) << "south: nothing changed";
  for (std::size_t i = 8; i < 16; ++i) EXPECT_NE(quiet[i].probabilities, loud_in_the_north[i].probabilities) << "north: louder";
}

TEST(ActionMap, StandingWhereTheVehicleStandsDiffersOnlyByASecondMeasurementThatSaysNothing) {
  const auto policy = place_policy(4);
  const std::vector<RecordedDecision> taken = flown(*policy, 2, {});
  const auto memory = remembered_at(policy->observation, falling_ocean(), taken, {});
  // A policy that sees its place alone does the same whatever it remembers.
  const ActionMap elsewhere = standing_elsewhere(*policy, falling_ocean(), 3, *memory);
  const ActionMap first = after_a_first_measurement(*policy, falling_ocean(), 3, nothing);
  for (std::size_t i = 0; i < elsewhere.size(); ++i) EXPECT_EQ(elsewhere[i].probabilities, first[i].probabilities);
}

TEST(ActionMap, StandingElsewhereRemembersTheVehiclesWayAndNoOtherPlaceOfTheMap) {
  const auto policy = belief_policy(4);
  const std::vector<RecordedDecision> taken = flown(*policy, 3, {});
  const auto memory = remembered_at(policy->observation, falling_ocean(), taken, {});
  const ActionMap nine = standing_elsewhere(*policy, falling_ocean(), 3, *memory);
  const ActionMap middle = standing_elsewhere(*policy, falling_ocean(), 1, *memory);
  ASSERT_EQ(nine[4].place, middle[0].place);
  EXPECT_EQ(nine[4].probabilities, middle[0].probabilities);
}

}  // namespace
}  // namespace earshot::explain
