#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/core/random.hpp"
#include "firmware/policy/ocean_belief/bearings.hpp"
#include "firmware/policy/ocean_belief/hypotheses/assumptions.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis_block.hpp"
#include "firmware/policy/ocean_belief/hypotheses/retained_hypotheses.hpp"
#include "firmware/policy/ocean_belief/measurement_history.hpp"
#include "firmware/policy/ocean_belief/measurement_weigher.hpp"

namespace earshot::policy {

/// Draws candidates, eight at a time, weighs them by the history of measurements, and has the likelier ones replace retained hypotheses. It
/// owns the eight that are being weighed, how far they are, the random numbers they are drawn with, and how much is left to be weighed.
class Replacement {
 public:
  /// There are no candidates, and nothing is to be weighed.
  void start();
  /// After a measurement: all that is to be weighed until the next one, or nothing where the history is not whole.
  void begin(const MeasurementHistory& history);
  /// Whether anything is left to be weighed.
  [[nodiscard]] bool is_left() const { return to_weigh_ > 0; }
  /// Weighs for a slice of time. What comes of all slices does not depend on when they are weighed.
  void weigh_slice(const Assumptions& assumed, const MeasurementHistory& history, const BearingSum& bearings, MeasurementWeigher& weigher,
                   RetainedHypotheses& retained);
  /// Candidates at rest take in the bearing of a new measurement at once, however far they are: the order is the same to them. Those that
  /// drift take it in with its measurement. @param index  of the measurement
  void take_in_bearing(const BeliefModel& model, const Measurement& measurement, std::uint32_t index, const BearingWeights& weights);

 private:
  [[nodiscard]] bool are_drifting() const { return !candidates_.hypothesis(0).drift.is_none(); }
  void draw(const Assumptions& assumed, const MeasurementHistory& history, const BearingSum& bearings, const RetainedHypotheses& retained);
  [[nodiscard]] int most_to_come(const Assumptions& assumed, int to_measure) const;

  HypothesisBlock candidates_;
  std::uint32_t weighed_ = 0;  ///< measurements by which the candidates have been weighed
  bool has_candidates_ = false;
  std::size_t to_weigh_ = 0;  ///< measurements by which candidates are still to be weighed
  Pcg32 random_{0};
};

}  // namespace earshot::policy
