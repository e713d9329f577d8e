#include <gtest/gtest.h>

#include <array>

#include "firmware/policy/action_values/action_values.hpp"

namespace earshot::policy {
namespace {

/// Ranges every kilometre, steps of 2 km of which each costs half of the one before, the first three times a silent one. By hand: silent
/// steps are 0.5 (1/2), 0.5, 1, 1, 1, and a quarter or all of those two ranges before; steps cost 6 (1 - 2^-k/2).
TEST(SearchCost, CountsSilentStepsByTheirDiscountAndAllStepsByTheirs) {
  BeliefModel model;
  model.step_length = Meters{2'000};
  model.costs = {.step = 3.0F, .log_step_discount = -0.69314718F};
  constexpr std::array<float, 8> kDetected{1, 1, 1, 0.5F, 0.5F, 0, 0, 0};
  constexpr std::array<float, 8> kSteps{0, 0, 0, 1.757359F, 3.0F, 3.878680F, 4.5F, 4.939340F};
  constexpr std::array<float, 8> kSilentQuartered{0, 0, 0, 0.25F, 0.5F, 1.0625F, 1.125F, 1.265625F};
  constexpr std::array<float, 8> kSilent{0, 0, 0, 0.25F, 0.5F, 1.25F, 1.5F, 2.25F};
  std::array<float, 8> cost;
  find_search_cost(model, Meters{1'000}, 0.25F, kDetected, cost);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(cost[i], kSteps[i] + kSilentQuartered[i], 1e-5F) << i;
  find_search_cost(model, Meters{1'000}, 1.0F, kDetected, cost);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(cost[i], kSteps[i] + kSilent[i], 1e-5F) << i;
}

/// Of a step of 1.499 km tables in steps of 1 km have one of 1 km, of one of 400 m too: a range more is then a step more, half of it
/// silent.
TEST(SearchCost, TakesAStepForTheNearestWholeNumberOfRangeStepsAndNoneForLessThanOne) {
  constexpr std::array<float, 5> kDetected{0.5F, 0.5F, 0.5F, 0.5F, 0.5F};
  constexpr std::array<float, 5> kSilent{0.0F, 0.0F, 0.5F, 1.0F, 1.5F};
  std::array<float, 5> cost;
  for (const double step_m : {1'499.0, 400.0}) {
    BeliefModel model;
    model.step_length = Meters{step_m};
    model.costs.step = 0.0F;
    find_search_cost(model, Meters{1'000}, 1.0F, kDetected, cost);
    EXPECT_EQ(cost, kSilent) << step_m;
  }
  BeliefModel model;
  model.step_length = Meters{1'501};
  model.costs.step = 0.0F;
  find_search_cost(model, Meters{1'000}, 1.0F, kDetected, cost);
  EXPECT_EQ(cost, (std::array<float, 5>{0.0F, 0.0F, 0.0F, 0.25F, 0.5F})) << "two ranges a step";
}

TEST(RangeSamples, RiseToTheNextAndBehindTheLastNoMore) {
  std::array<RangeSample, 3> samples;
  find_samples(std::array{1.0F, 3.0F, 2.5F}, std::array{0.75F, 0.5F, 0.5F}, samples);
  const std::array<std::array<float, 4>, 3> expected{{{1.0F, 2.0F, 0.75F, -0.25F}, {3.0F, -0.5F, 0.5F, 0.0F}, {2.5F, 0.0F, 0.5F, 0.0F}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [search_cost, search_cost_rise, detected, detected_rise] = samples[i];
    EXPECT_EQ((std::array{search_cost, search_cost_rise, detected, detected_rise}), expected[i]) << i;
  }
}

}  // namespace
}  // namespace earshot::policy
