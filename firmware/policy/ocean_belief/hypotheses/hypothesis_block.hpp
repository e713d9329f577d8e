#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/policy/belief/belief_model.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis.hpp"
#include "firmware/policy/ocean_belief/log_weight/lanes.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

namespace earshot::policy {

/// No place gets less likely than the likeliest by more than 2^-26, 4e-5 of all in 2500 cells: a belief that was wrong, or a source that
/// moved, can come back.
inline constexpr std::int16_t kForgotten = -26 * kOctave;
/// The least log weight of a measurement: sixteen bits hold it together with a place that is all but forgotten.
inline constexpr std::int16_t kLeastLogLikelihood = -32'768 - kForgotten;

/// How likely every place is whatever the hypothesis.
struct PlacePrior {
  /// [north x east]; at least kForgotten, the likeliest 0. Without initial values: what fills it knows how many cells there are, and zeros
  /// would take flash and time.
  std::array<std::int16_t, config::kMaxBeliefCells> log_weights;
  int scale = 0;  ///< what has been taken off every weight
};

/// The probability of every place under each of eight hypotheses, as log weights.
class HypothesisBlock {
 public:
  void start(const BeliefModel& model, const std::array<Hypothesis, kLanes>& hypotheses, const PlacePrior& prior);
  /// The same where every place is as likely as another.
  void start(const BeliefModel& model, const std::array<Hypothesis, kLanes>& hypotheses);
  /// The source may have moved since the last measurement, where a hypothesis says so.
  void let_move(const BeliefModel& model);
  /// Multiplies every cell by its likelihood under those hypotheses that have the cells at these ranges.
  /// @param raised_log_likelihoods  [ranges]: of what was heard, were the source at each, kLeastLogLikelihood to 0, and raised by
  ///                                -kLeastLogLikelihood: 0 is the least
  /// @param ranges                  [north x east]: of the cells
  void weigh(const BeliefModel& model, const Lanes& lanes, std::span<const LogLanes> raised_log_likelihoods,
             std::span<const std::uint16_t> ranges);

  /// Multiplies every cell by a likelihood of its own under some of the hypotheses.
  /// @param log_likelihoods  [north x east], at most 0, at least kForgotten
  void weigh_places(const BeliefModel& model, const Lanes& lanes, std::span<const std::int16_t> log_likelihoods);

  [[nodiscard]] const Hypothesis& hypothesis(std::size_t lane) const { return hypotheses_[lane]; }
  [[nodiscard]] const std::array<Hypothesis, kLanes>& hypotheses() const { return hypotheses_; }
  [[nodiscard]] bool holds(const Hypothesis& hypothesis) const;
  /// log2 of the probability of all that was heard under each hypothesis, in 1/512, with a constant in common.
  [[nodiscard]] std::array<int, kLanes> log_evidence(const BeliefModel& model) const;
  /// The same of the likeliest place alone, which costs nothing; every place adds at most as much.
  [[nodiscard]] int log_of_likeliest(std::size_t lane) const { return scale_[lane] + highest_[lane]; }
  /// Adds the probability of every cell in a window, those of a hypothesis adding up to its share over all of them.
  /// @param is_first  nothing has been added yet: whatever the window holds is overwritten
  /// @param marginal  [north x east]
  void add_to(const BeliefModel& model, const FloatLanes& shares, const CellWindow& window, bool is_first, std::span<float> marginal) const;

  /// The same for one hypothesis, whose cells have gone elsewhere; the window is of where they have gone.
  /// @param axes  in which of the cells they now are (CellPlaces::find_axes)
  void add_to(const BeliefModel& model, std::size_t lane, float share, std::span<const std::uint16_t> axes, const CellWindow& window,
              std::span<float> marginal) const;

  /// Takes a hypothesis of another block in the place of one of its own.
  void take_over(const BeliefModel& model, std::size_t lane, const HypothesisBlock& from, std::size_t from_lane);
  /// CRC-32 of all its weights. @param crc  of what stands before them
  [[nodiscard]] std::uint32_t fingerprint(const BeliefModel& model, std::uint32_t crc) const;

 private:
  [[nodiscard]] const FloatLanes& sums(const BeliefModel& model) const;
  template <std::size_t kCount>
  void sum_words(const BeliefModel& model, std::size_t first) const;
  void take_off_highest(const Lanes& lanes);
  void spread_word(const BeliefModel& model, std::size_t word, const LogLanes& penalties);

  // Without initial values but for the first and the last: start() writes all that is read, and zeros in every block would take flash and
  // time.
  std::array<Hypothesis, kLanes> hypotheses_;
  /// [north x east]; none counts as less than the highest of its hypothesis and kForgotten.
  std::array<LogLanes, config::kMaxBeliefCells> weights_;
  LogLanes highest_;               ///< of each hypothesis; at least kLeastLogLikelihood
  std::array<int, kLanes> scale_;  ///< what has been taken off every weight of a hypothesis
  mutable FloatLanes sums_;        ///< of each hypothesis over the cells, the likeliest counted as one
  mutable bool has_sums_ = false;  ///< of the weights as they are
};

}  // namespace earshot::policy
