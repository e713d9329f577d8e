#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/policy/action_values/action_values.hpp"
#include "firmware/policy/ocean_belief/hypotheses/assumptions.hpp"
#include "firmware/policy/ocean_belief/hypotheses/retained_hypotheses.hpp"
#include "firmware/policy/ocean_belief/measurement_history.hpp"

namespace earshot::policy {

/// Assesses what each action of the vehicle promises under all retained hypotheses. It owns the action values, and where the vehicle was
/// when they were found.
class ActionAssessment {
 public:
  /// No action promises anything.
  void start();
  /// Finds the values of every action after the last measurement of the history.
  /// @param corner    of the area, as the likeliest current has carried it
  /// @param marginal  [north x east]: probability of every cell, counted from that corner
  void find(const Assumptions& assumed, const RetainedHypotheses& retained, const MeasurementHistory& history, NorthEast position,
            NorthEast corner, std::span<const float> marginal);

  /// Of all actions that there is room for. Those that the model does not have are zero.
  [[nodiscard]] std::span<const ActionValues> values() const { return values_; }
  /// Probability that a measurement there is a detection: that of the action whose end is next to it; before any measurement 0.
  [[nodiscard]] float expected_detection(const BeliefModel& model, NorthEast position) const;

 private:
  std::size_t tabulate(const Assumptions& assumed, const RetainedHypotheses& retained, NorthEast position);
  void find_regrets(const BeliefModel& model, const RetainedHypotheses& retained, const MeasurementHistory& history, NorthEast position);

  std::array<ActionValues, config::kMaxActions> values_{};
  NorthEast position_;
  // Without initial values: find() tabulates before it reads, and zeros would take flash and time.
  std::array<RangeSample, config::kMaxTableRanges> by_range_;
};

}  // namespace earshot::policy
