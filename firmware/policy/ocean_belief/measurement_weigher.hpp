#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/policy/ocean_belief/bearings.hpp"
#include "firmware/policy/ocean_belief/hypotheses/assumptions.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis_block.hpp"
#include "firmware/policy/ocean_belief/hypotheses/lane_likelihoods.hpp"
#include "firmware/policy/ocean_belief/measurement_history.hpp"

namespace earshot::policy {

/// Weighs the places of a block by a measurement, retained hypotheses and candidates alike. It owns the memory that this takes, and nothing
/// in it is needed by the next call; BearingWeights hold until the next call.
class MeasurementWeigher {
 public:
  /// By all but the bearing. @param index  of the measurement, counted from 0
  void weigh(const Assumptions& assumed, const Measurement& measurement, std::uint32_t index, HypothesisBlock& block);
  /// The source is not within a step length of the vehicle at that measurement.
  void rule_out(const Assumptions& assumed, NorthEast position, std::uint32_t index, HypothesisBlock& block);
  /// What the bearing of a measurement means, for weigh_by_bearing(). @param measurement  with a bearing
  [[nodiscard]] BearingWeights bearing_weights(const BeliefModel& model, const Measurement& measurement);

 private:
  void weigh_snr(const Assumptions& assumed, const Measurement& measurement, std::uint32_t index, HypothesisBlock& block);

  // Without initial values: nothing is read here that the same call has not written, and zeros would take flash and time.
  LaneLikelihoods likelihoods_;
  std::array<std::uint16_t, config::kMaxBeliefCells> ranges_;  ///< [north x east], from the vehicle, in range steps
  std::array<std::int16_t, config::kMaxBeliefCells> by_cell_;  ///< [north x east], log weights of a bearing, or of a declaration
};

}  // namespace earshot::policy
