#include "firmware/policy/ocean_belief/expected_border.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/firmware/policy/belief/belief_rig.hpp"

namespace earshot::policy {
namespace {

/// 10 km x 20 km with a border of 2 km, steps of 1 km to the north, east, south and west.
BeliefModel with_border() {
  BeliefModel model = bare_model(at(10'000, 20'000), 10, 20);
  model.border_width = Meters{2'000};
  model.costs.edge = 60.0F;
  model.costs.most_regret = 1'000.0F;
  return model;
}

TEST(ExpectedBorder, IsTheMeanOverThePlacesWhereTheVehicleMayBe) {
  std::array<ActionValues, 4> action_values{};
  // At 9.5 km it is 1.5 km deep in the northern border; at 5 km nowhere near one.
  expect_border(with_border(), std::array{PossiblePlace{at(9'500, 10'000), 0.25F}, PossiblePlace{at(5'000, 10'000), 0.75F}}, action_values);
  EXPECT_FLOAT_EQ(action_values[kNorth].border, 0.25F * 1.25F);
  EXPECT_FLOAT_EQ(action_values[kEast].border, 0.25F * 0.75F);
  EXPECT_FLOAT_EQ(action_values[kSouth].border, 0.25F * 0.25F);
  EXPECT_FLOAT_EQ(action_values[kWest].border, 0.25F * 0.75F);
}

TEST(ExpectedBorder, StandsAtEveryEdge) {
  const std::array<NorthEast, 4> at_the_edges{at(10'000, 10'000), at(5'000, 20'000), at(0, 10'000), at(5'000, 0)};
  for (std::size_t edge = 0; edge < 4; ++edge) {
    std::array<ActionValues, 4> action_values{};
    expect_border(with_border(), std::array{PossiblePlace{at_the_edges[edge], 1.0F}}, action_values);
    for (std::size_t a = 0; a < 4; ++a)
      EXPECT_FLOAT_EQ(action_values[a].border, a == edge ? 1.5F : a == (edge + 2) % 4 ? 0.5F : 1.0F) << edge << ", " << a;
  }
}

/// Regrets that counted a border of 1 for all, 60 too much where there is none, which no place has but the second of two, to the south.
TEST(ExpectedBorder, TakesThePlaceOfTheOneInTheRegrets) {
  std::array<ActionValues, 4> action_values{};
  action_values.fill({.border = 1.0F, .regret = 65.0F});
  action_values[kEast].regret = 69.0F;
  const std::array places{PossiblePlace{at(5'000, 10'000), 0.5F}, PossiblePlace{at(2'000, 10'000), 0.5F}};
  expect_border(with_border(), places, action_values);
  EXPECT_FLOAT_EQ(action_values[kNorth].regret, 5.0F);
  EXPECT_FLOAT_EQ(action_values[kEast].regret, 9.0F);
  EXPECT_FLOAT_EQ(action_values[kSouth].regret, 5.0F + 0.25F * 60.0F);
  EXPECT_FLOAT_EQ(action_values[kWest].regret, 5.0F);
}

TEST(ExpectedBorder, GetsNoDeeperFarOutside) {
  std::array<ActionValues, 4> action_values{};
  expect_border(with_border(), std::array{PossiblePlace{at(-90'000, 10'000), 0.5F}}, action_values);
  for (const ActionValues& values : action_values) EXPECT_FLOAT_EQ(values.border, 0.5F * 3.0F);
}

}  // namespace
}  // namespace earshot::policy
