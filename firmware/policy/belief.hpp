#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/messages/belief_summary.hpp"
#include "firmware/policy/belief_model.hpp"
#include "firmware/policy/belief_outlook.hpp"
#include "firmware/policy/reception.hpp"

namespace earshot::policy {

/// Probability of the source's place over a grid, in fixed memory.
class Belief {
 public:
  /// Forgets everything: every place is as likely as any other.
  void start(const BeliefModel& model);
  /// Takes in what was heard at `position` (relative to the area's south-west corner), where the source was not within step_length.
  void update(const BeliefModel& model, NorthEast position, Reception reception);

  /// Places are relative to the area's south-west corner.
  [[nodiscard]] const messages::BeliefSummary& summary() const { return summary_; }
  /// @param action  below the number of the model's actions
  [[nodiscard]] const ActionOutlook& outlook(std::size_t action) const { return outlooks_[action]; }
  /// Probability that the source lies in a cell, counted from the south and from the west.
  [[nodiscard]] float probability(const BeliefModel& model, std::size_t north, std::size_t east) const {
    return marginal_[north * model.cells_east + east];
  }
  /// CRC-32 of all that is believed: the probability of every cell with every hypothesis, and every action's outlook, bit for bit.
  [[nodiscard]] std::uint32_t fingerprint(const BeliefModel& model) const;
  /// Probability of a hypothesis.
  [[nodiscard]] float probability_of_hypothesis(std::size_t hypothesis) const { return hypothesis_shares_[hypothesis]; }

 private:
  /// Probability of each hypothesis together with one cell.
  using Cell = std::array<float, config::kMaxBeliefHypotheses>;

  void begin_anew(std::size_t cells);
  void foresee(const BeliefModel& model);
  void weigh_bearing(const BeliefModel& model, NorthEast position, const messages::Bearing& bearing);
  void weigh(const BeliefModel& model, Reception reception);
  void normalise(const BeliefModel& model, const Cell& sums);

  std::array<Cell, config::kMaxBeliefCells> cells_;            ///< [north x east]; hypotheses that the model has not are zero
  std::array<float, config::kMaxBeliefCells> marginal_;        ///< [north x east], sum over the hypotheses
  std::array<std::uint16_t, config::kMaxBeliefCells> ranges_;  ///< [north x east], from the vehicle, in range steps
  std::array<float, config::kMaxBeliefRanges> search_cost_;    ///< of a search that goes straight to a source at that range
  std::array<float, config::kMaxBeliefRanges> detected_;       ///< probability of a detection at that range
  Cell priors_;                                                ///< of the hypotheses
  Cell hypothesis_shares_;
  messages::BeliefSummary summary_;
  std::array<ActionOutlook, config::kMaxActions> outlooks_;
};

static_assert(sizeof(Belief) <= config::kBeliefBytes);

}  // namespace earshot::policy
