#pragma once

#include <cstdint>
#include <span>

#include "firmware/policy/belief/belief_model.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis_block.hpp"
#include "firmware/policy/ocean_belief/measurement_history.hpp"

namespace earshot::policy {

/// What one bearing means for every cell of the area.
struct BearingWeights {
  std::span<const std::int16_t> by_cell;  ///< [north x east], log weights, at least kForgotten, the highest 0
  int taken_off;                          ///< of every weight: the highest before
};

/// @param measurement  with a bearing   @param by_cell  [north x east], memory for the result
[[nodiscard]] BearingWeights find_bearing_weights(const BeliefModel& model, const Measurement& measurement,
                                                  std::span<std::int16_t> by_cell);

/// Weighs the places of a block by a bearing. A cell that has drifted takes the weight of the cell that it is in; beyond the area that of
/// its place.
/// @param measurement  with that bearing   @param index  of the measurement, counted from 0
void weigh_by_bearing(const BeliefModel& model, const Measurement& measurement, std::uint32_t index, const BearingWeights& weights,
                      HypothesisBlock& block);

/// What all bearings together mean for the places of a source at rest. It owns that sum, with which a hypothesis at rest begins.
class BearingSum {
 public:
  /// There is no bearing.
  void start(const BeliefModel& model);
  void add(const BeliefModel& model, const BearingWeights& weights);
  [[nodiscard]] const PlacePrior& sum() const { return sum_; }
  [[nodiscard]] bool is_empty() const { return is_empty_; }

 private:
  PlacePrior sum_;
  bool is_empty_ = true;
};

}  // namespace earshot::policy
