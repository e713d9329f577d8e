#include "firmware/policy/ocean_belief/hypotheses/candidates.hpp"

#include <algorithm>

namespace earshot::policy {
namespace {

using Weights = std::array<float, kRetainedHypotheses>;

/// Of the trials so many are of drifts: where no drift is likely, and where nothing else is.
constexpr float kLeastDrifting = 0.3F;
constexpr float kMostDrifting = 0.8F;
/// Of the others so many move; of those that drift so many move besides.
constexpr float kMoving = 0.25F;
/// Of the trials of drifts so many are of a retained hypothesis, the others of one like it.
constexpr float kOfOneRetained = 0.7F;
/// Draws of one hypothesis before one that is retained already is taken again.
constexpr int kDraws = 8;

/// By the root of its share: one that is nearly certain is not the only one to go on from.
Weights roots(const RetainedShares& retained) {
  Weights weights;
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = __builtin_sqrtf(retained.shares[i]);
  return weights;
}

/// One of those that are retained, drawn with the probabilities that are proportional to the weights.
const Hypothesis& draw_retained(const RetainedShares& retained, const Weights& weights, Pcg32& random) {
  float sum = 0.0F;
  for (const float weight : weights) sum += weight;
  float left = random.uniform_float() * sum;
  std::size_t i = 0;
  while (i + 1 < weights.size() && (left -= weights[i]) >= 0.0F) ++i;
  return retained.hypotheses[i];
}

Hypothesis draw_one(const RetainedShares& retained, const OceanTables& tables, Motion motion, Pcg32& random) {
  if (random.uniform_float() < 0.5F) return draw_hypothesis(tables, motion, random);
  Hypothesis h = draw_neighbour(draw_retained(retained, roots(retained), random), tables, motion, random);
  h.drift = {};
  return h;
}

Hypothesis draw_to_drift(const RetainedShares& retained, const OceanTables& tables, Pcg32& random) {
  const Motion motion = random.uniform_float() < kMoving ? Motion::kMoving : Motion::kAtRest;
  const Hypothesis& parent = draw_retained(retained, roots(retained), random);
  Hypothesis h = random.uniform_float() < kOfOneRetained ? parent : draw_neighbour(parent, tables, motion, random);
  if (motion == Motion::kAtRest) h.mobility = 0;
  return h;
}

/// Half of them are like one that is retained, if one is.
Drift draw_next_drift(const RetainedShares& retained, Pcg32& random) {
  Weights weights = roots(retained);
  float sum = 0.0F;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (retained.hypotheses[i].drift.is_none()) weights[i] = 0.0F;
    sum += weights[i];
  }
  if (sum == 0.0F || random.uniform_float() < 0.5F) return draw_drift(random);
  return draw_neighbour(draw_retained(retained, weights, random).drift, random);
}

}  // namespace

bool RetainedShares::holds(const Hypothesis& hypothesis) const {
  return std::ranges::find(hypotheses, hypothesis) != hypotheses.end();
}

float RetainedShares::drifting() const {
  float sum = 0.0F;
  for (std::size_t i = 0; i < hypotheses.size(); ++i) sum += hypotheses[i].drift.is_none() ? 0.0F : shares[i];
  return sum;
}

Trial draw_trial(const RetainedShares& retained, Pcg32& random) {
  if (random.uniform_float() < kLeastDrifting + (kMostDrifting - kLeastDrifting) * retained.drifting()) return Trial::kDrifting;
  return random.uniform_float() < kMoving ? Trial::kMoving : Trial::kAtRest;
}

std::array<Hypothesis, kLanes> draw_candidates(const RetainedShares& retained, const OceanTables& tables, Trial trial, Pcg32& random) {
  std::array<Hypothesis, kLanes> candidates;
  Hypothesis drifting;
  if (trial == Trial::kDrifting) drifting = draw_to_drift(retained, tables, random);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    for (int draw = 0; draw < kDraws; ++draw) {
      Hypothesis& h = candidates[i];
      if (trial == Trial::kDrifting) {
        h = drifting;
        h.drift = draw_next_drift(retained, random);
      } else {
        h = draw_one(retained, tables, trial == Trial::kMoving ? Motion::kMoving : Motion::kAtRest, random);
      }
      if (!retained.holds(h) && std::ranges::find(candidates.data(), &h, h) == &h) break;
    }
  }
  return candidates;
}

}  // namespace earshot::policy
