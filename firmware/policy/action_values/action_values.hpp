#pragma once

#include <cstddef>
#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/policy/belief/belief_model.hpp"

namespace earshot::policy {

/// What one action promises, under the belief b(s) about the source's place s. See find_action_values().
struct ActionValues {
  float found = 0.0F;             ///< probability that its end lies within step_length of the source
  float find_probability = 0.0F;  ///< the same for the best place within kFindSteps steps of which it is one, discounted; at least 0
  float detected = 0.0F;          ///< probability of a detection at its end
  float border = 0.0F;            ///< how deep its end lies in the border: 0 inside, 1 at the edge, more beyond
  float regret = 0.0F;  ///< expected cost of the search after it, less that after the best action; at most BeliefCosts::most_regret
};

/// Steps over which the find probability looks ahead: as many as the time of a decision allows.
inline constexpr std::size_t kFindSteps = 3;

/// What depends on the range r to a source alone, and how much more it is a range_step further; at the end of a table 0.
struct RangeSample {
  float search_cost;  ///< C(r): of a search that goes straight to a source at that range
  float search_cost_rise;
  float detected;  ///< D(r): probability of a detection
  float detected_rise;
};

/// One sample every range_step; between two linear, beyond the end as at the end.
struct ValuesByRange {
  std::span<const RangeSample> samples;
  Meters range_step;  ///< > 0
};

/// Tabulates C(r), see find_action_values().
/// @param range_step        of the tables, > 0
/// @param silence_discount  of a silent step's cost, that of the one before it being one: g_S in S(r) = (1 - D(r)) min(1, (r - l) / l) +
///                          g_S S(r - l). With 1 all are worth the same; then a vehicle amid places that are as likely on every side, and
///                          too far to hear from, may find no way better than another and stay
/// @param detected          D(r): probability of a detection at every range
/// @param search_cost       [ranges], of which there are at most kMaxTableRanges; the result
void find_search_cost(const BeliefModel& model, Meters range_step, float silence_discount, std::span<const float> detected,
                      std::span<float> search_cost);

/// Samples of both. @param samples  [ranges], as they are; the result
void find_samples(std::span<const float> search_cost, std::span<const float> detected, std::span<RangeSample> samples);

/// Finds what each action promises to a vehicle at x. With l = step_length, x_a the end of action a, and B(y) how deep a place y lies in
/// the border (0 inside, 1 at the edge):
///
///   found_a    = P(|s - x_a| <= l)
///   detected_a = E[D(|s - x_a|)]
///   border_a   = B(x_a)
///   find_a     = max(0, max over y of  g^(n-1) P(|s - y| <= l) - (e / r) B(y)),   y: the ends of all paths of n = 1 ... kFindSteps
///                steps of which a is one, in any order
///   cost_a     = E[C(way(x_a, s))] + e border_a - r find_a
///   regret_a   = min(cost_a - min over a' of cost_a', most_regret)
///
/// where a search that goes straight to a source at range r is silent in S(r) of its steps, and pays for each of them, and c g_s^k for its
/// k-th:
///
///   C(r) = S(r) + c (1 - g_s^((r - l) / l)) / (1 - g_s),   S(r) = (1 - D(r)) min(1, (r - l) / l) + S(r - l) for r > l, else 0
///
/// with c, log g_s = costs.step, .log_step_discount; g, r, e, most_regret = costs.find_discount, .find_probability, .edge, .most_regret.
/// The way to a source in the border ends where it is found without entering the border: way(x, s) = max(|s - x|, |c - x| + l - sqrt(l^2 -
/// |s - c|^2)), c: the place outside the border nearest to s (the root is 0 where |s - c| > l). P counts a cell by as much of it as lies
/// within l; E takes blocks of 2 x 2 cells as a point each. The find probability is 0 where hardly any of the belief is near. Unlikely
/// cells and blocks are left out: README.md says what that costs.
/// @param probabilities  b: of the cells of the model's grid, [north x east]
/// @param position       x, relative to the area's south-west corner
/// @param action_values       [actions]; the result
/// Oracle: ActionValuesTest.*, FindActionValues.*, StripTest.*, OceanBeliefTest.HasTheSameBitsOnEveryMachine
void find_action_values(const BeliefModel& model, std::span<const float> probabilities, const ValuesByRange& by_range, NorthEast position,
                        std::span<ActionValues> action_values);

}  // namespace earshot::policy
