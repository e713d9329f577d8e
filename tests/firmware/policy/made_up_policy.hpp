#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string_view>

#include "firmware/core/random.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::policy {

inline constexpr std::string_view kProvenance = "command = earshot train\n";

/// What a freezer does last.
inline void record(FrozenPolicy& policy) {
  record_golden(policy, *std::make_unique<SearchMemory>(), *std::make_unique<OceanTables>());
}

inline bool repeats(const FrozenPolicy& policy) {
  return repeats_golden(policy, *std::make_unique<SearchMemory>(), *std::make_unique<OceanTables>());
}

/// A 2-5-3-4 policy with weights from a generator; its golden searches go north-east from (1 km, 2 km) in steps of 1 km.
inline std::unique_ptr<FrozenPolicy> small_policy() {
  auto policy = std::make_unique<FrozenPolicy>();
  policy->observation.spec = simple_state({.north = Meters{25000}, .east = Meters{25000}});
  for (const UnitNorthEast& direction : {UnitNorthEast{1, 0}, UnitNorthEast{0, 1}, UnitNorthEast{-1, 0}, UnitNorthEast{0.6, -0.8}}) {
    EXPECT_EQ(policy->actions.push_back(direction), Status::kOk);
  }
  policy->step_length = Meters{1000};
  policy->area_size = {.north = Meters{25000}, .east = Meters{26000}};
  policy->detection_threshold = Decibels{-3.5};
  policy->draw = ActionDraw::kSampled;
  policy->network.observation_size = 2;
  policy->network.hidden_sizes = {5, 3};
  policy->network.action_count = 4;
  Pcg32 random(21);
  const auto fill = [&random](const auto& layer, std::size_t outputs, std::size_t inputs) {
    for (std::size_t i = 0; i < outputs * inputs; ++i) layer.weight(i / inputs, i % inputs) = random.uniform_float() - 0.5F;
    for (std::size_t i = 0; i < outputs; ++i) layer.bias[i] = random.uniform_float() - 0.5F;
  };
  fill(policy->network.layer(0), 5, 2);
  fill(policy->network.layer(1), 3, 5);
  fill(policy->network.layer(2), 4, 3);
  for (const char character : kProvenance) EXPECT_EQ(policy->provenance.push_back(character), Status::kOk);
  for (GoldenTrajectory& trajectory : policy->golden) {
    double along = 1000.0;
    for (GoldenStep& step : trajectory) {
      step.place = {.north = Meters{along}, .east = Meters{along + 1000.0}};
      step.reception = {.snr = Decibels{along / 1000.0}, .too_faint = along > 4000.0};
      along += 1000.0;
    }
  }
  record(*policy);
  return policy;
}

inline std::unique_ptr<FrozenPolicy> new_believing_policy() {
  auto policy = small_policy();
  BeliefModel& belief = policy->observation.belief;
  belief.actions = policy->actions;
  belief.step_length = policy->step_length;
  belief.area_size = policy->area_size;
  belief.detection_threshold = policy->detection_threshold;
  belief.border_width = Meters{700};
  belief.costs = {
      .step = 2.5F, .log_step_discount = -0.25F, .find_probability = 20.0F, .find_discount = 0.75F, .edge = 50.0F, .most_regret = 9.0F};
  belief.cells_north = 49;
  belief.cells_east = 51;
  belief.outlier_share = 0.125F;
  policy->observation.spec.clear();
  EXPECT_EQ(policy->observation.spec.push_back({.feature = Feature::kPreference, .age = 3}), Status::kOk);
  EXPECT_EQ(policy->observation.spec.push_back({.feature = Feature::kSpread, .scale = 1e-4F}), Status::kOk);
  record(*policy);
  return policy;
}

/// small_policy() that sees a belief. Its golden searches are flown once, for they take longer than whatever is asked of it.
inline std::unique_ptr<FrozenPolicy> believing_policy() {
  static const std::unique_ptr<const FrozenPolicy> kept = new_believing_policy();
  return std::make_unique<FrozenPolicy>(*kept);
}

inline std::unique_ptr<FrozenPolicy> new_advising_policy() {
  auto policy = believing_policy();
  policy->observation.spec.clear();
  EXPECT_EQ(policy->observation.spec.push_back({.feature = Feature::kSpread, .scale = 1e-4F}), Status::kOk);
  for (std::uint8_t action = 4; action-- > 0;)
    EXPECT_EQ(policy->observation.spec.push_back({.feature = Feature::kPreference, .age = action}), Status::kOk);
  policy->network = {};
  policy->network.observation_size = policy->observation.spec.size();
  policy->network.action_count = policy->actions.size();
  for (GoldenTrajectory& trajectory : policy->golden) {
    for (GoldenStep& step : trajectory) step = {.place = step.place, .reception = step.reception, .belief = {}};
  }
  record(*policy);
  return policy;
}

/// believing_policy() without a network: it sees how far the belief spreads, then the preferences of its four actions, the last first.
inline std::unique_ptr<FrozenPolicy> advising_policy() {
  static const std::unique_ptr<const FrozenPolicy> kept = new_advising_policy();
  return std::make_unique<FrozenPolicy>(*kept);
}

}  // namespace earshot::policy
