#include "firmware/policy/golden.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>

#include "firmware/core/math.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::policy {
namespace {

bool is_same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

bool is_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool is_same(NorthEast a, NorthEast b) {
  return is_same(a.north.value, b.north.value) && is_same(a.east.value, b.east.value);
}

bool is_same(const messages::BeliefSummary& a, const messages::BeliefSummary& b) {
  return is_same(a.likeliest, b.likeliest) && is_same(a.mean, b.mean) && is_same(a.spread.value, b.spread.value) &&
         is_same(a.likeliest_share, b.likeliest_share) && is_same(a.effective_cells, b.effective_cells);
}

bool is_same(std::span<const float> a, std::span<const float> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) { return is_same(x, y); });
}

/// The part that does not depend on the policy's sizes: elements that it has not are zero in both.
bool is_same(const GoldenStep& a, const GoldenStep& b) {
  return is_same(a.belief, b.belief) && a.fingerprint == b.fingerprint && is_same(a.observation, b.observation) &&
         is_same(a.logits, b.logits);
}

/// The step as this build flies it, the one before being the last that `memory` knows of.
GoldenStep flown(const FrozenPolicy& policy, const GoldenStep& step, bool is_first, SearchMemory& memory) {
  const ObservationModel& model = policy.observation;
  is_first ? memory.start(model, step.place, step.reception.heard()) : memory.remember(model, step.place, step.reception.heard());
  GoldenStep again;
  again.place = step.place;
  again.reception = step.reception;
  if (needs_belief(model.spec)) {
    again.belief = memory.belief().summary();
    again.fingerprint = memory.belief().fingerprint(model.belief);
  }
  const std::span<float> observation = std::span(again.observation).first(model.spec.size());
  observe(memory, model, observation);
  forward(policy.network, observation, std::span(again.logits).first(policy.actions.size()));
  return again;
}

}  // namespace

void record_golden(FrozenPolicy& policy, SearchMemory& memory) {
  for (GoldenTrajectory& trajectory : policy.golden) {
    bool is_first = true;
    for (GoldenStep& step : trajectory) {
      step = flown(policy, step, is_first, memory);
      is_first = false;
    }
  }
}

bool repeats_golden(const FrozenPolicy& policy, SearchMemory& memory) {
  const auto all_finite = [](std::span<const float> values) {
    return std::all_of(values.begin(), values.end(), [](float value) { return is_finite(value); });
  };
  for (const GoldenTrajectory& trajectory : policy.golden) {
    bool is_first = true;
    for (const GoldenStep& step : trajectory) {
      const GoldenStep again = flown(policy, step, is_first, memory);
      if (!is_same(again, step) || !all_finite(again.logits)) return false;
      is_first = false;
    }
  }
  return true;
}

}  // namespace earshot::policy
