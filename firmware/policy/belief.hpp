#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/belief_summary.hpp"
#include "firmware/policy/heard.hpp"

namespace earshot::policy {

/// One way in which the SNR heard may differ from the one modelled.
struct BeliefHypothesis {
  float level_offset_db = 0.0F;  ///< the source is that much louder than the model says
  float spread_db = 4.0F;        ///< standard deviation of what is measured about that, > 0
  float prior = 1.0F;            ///< > 0; priors need not add up to one
  friend constexpr bool operator==(const BeliefHypothesis&, const BeliefHypothesis&) = default;
};

/// What a search costs, for the outlook; a step on which nothing is detected costs one. The defaults are the paper's search.
struct BeliefCosts {
  float step = 3.0F;  ///< of a step, the first of many, 0 to 1e6
  /// ln of what each step after it costs of the one before, -10 to -1e-3: a likely source near by is worth more than two half as likely
  /// further away. The default is ln 0.9.
  float log_step_discount = -0.105360516F;
  float reach = 30.0F;           ///< what a reach of one is worth, 1e-3 to 1e6
  float reach_discount = 0.85F;  ///< of a reach that is one step further away, 0 to 1
  float edge = 100.0F;           ///< of the border at the edge itself, 0 to 1e6: -p of the paper's reward
  float most_regret = 10.0F;     ///< no regret counts for more, 0 to 1e6
  friend constexpr bool operator==(const BeliefCosts&, const BeliefCosts&) = default;
};

/// What a belief takes for granted; travels in the `.policy` file. Used only by observations that see a belief.
struct BeliefModel {
  // The search; in a FrozenPolicy the same as its own.
  NorthEast area_size;          ///< the source lies in the area, both > 0
  Meters step_length{1'000.0};  ///< within it of the source the search ends
  Decibels detection_threshold{10.0};
  FixedVector<UnitNorthEast, config::kMaxActions> actions;
  Meters border_width{1'000.0};  ///< of the edge that a policy had better not enter, > 0
  BeliefCosts costs;

  std::uint16_t cells_north = 50;  ///< cells_north * cells_east <= kMaxBeliefCells
  std::uint16_t cells_east = 50;
  FixedVector<BeliefHypothesis, config::kMaxBeliefHypotheses> hypotheses;
  float outlier_share = 0.02F;  ///< of SNRs that follow no model, 0 to 1
  float silence_share = 0.0F;   ///< of the looks that meet a pause in the call, when nothing is heard at any range, 0 to 1
  float forgotten_share =
      1e-4F;  ///< of the belief that is spread over the whole area between two looks, 0 to 0.5: the source may have moved

  Meters range_step{100.0};  ///< > 0
  FixedVector<float, config::kMaxBeliefRanges>
      snr_db;  ///< SNR at the vehicle's depth at range i * range_step; beyond its end as at its end
};

/// Whether every size fits its capacity and is not zero.
[[nodiscard]] bool has_valid_shape(const BeliefModel& model);
/// Whether every number is in its range: spread 0.05 to 100 dB, offsets and SNRs within kMostSnr, priors 1e-6 to 1e6; range step 1 m to
/// 10 km, step and border 1 m to 1000 km, area 1 m to 10 000 km, costs as said at each. @param model  of a valid shape
[[nodiscard]] bool has_valid_numbers(const BeliefModel& model);

/// What one action promises, under the belief.
struct ActionOutlook {
  float found = 0.0F;  ///< probability that its end lies within step_length of the source
  /// The same for the best place within kReachSteps steps of which it is one, a step later counting reach_discount less, and the border's
  /// cost there (edge / reach of its depth) taken off; at least 0.
  float reach = 0.0F;
  float detected = 0.0F;  ///< probability of a detection at its end
  float border = 0.0F;    ///< how deep its end lies in the border: 0 inside, 1 at the edge, more beyond
  float regret = 0.0F;    ///< expected cost of the search after it, less that after the best action; at most BeliefCosts::most_regret
};

inline constexpr std::size_t kReachSteps = 3;  ///< as many as the time of a decision allows

/// Probability of the source's place over a grid, in fixed memory.
class Belief {
 public:
  /// Forgets everything: every place is as likely as any other.
  void start(const BeliefModel& model);
  /// Takes in what was heard at `position` (relative to the area's south-west corner), where the source was not within step_length.
  void update(const BeliefModel& model, NorthEast position, Heard heard);

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
  void find_ranges(const BeliefModel& model, NorthEast position);
  void weigh(const BeliefModel& model, Heard heard);
  void normalise(const BeliefModel& model, const Cell& sums);
  void summarise(const BeliefModel& model);
  void look_out(const BeliefModel& model, NorthEast position);

  std::array<Cell, config::kMaxBeliefCells> cells_;            ///< [north x east]; hypotheses that the model has not are zero
  std::array<float, config::kMaxBeliefCells> marginal_;        ///< [north x east], sum over the hypotheses
  std::array<std::uint16_t, config::kMaxBeliefCells> ranges_;  ///< [north x east], from the vehicle, in range steps
  std::array<float, config::kMaxBeliefRanges> cost_;           ///< of a search that goes straight to a source at that range
  std::array<float, config::kMaxBeliefRanges> detected_;       ///< probability of a detection at that range
  Cell priors_;                                                ///< of the hypotheses
  Cell hypothesis_shares_;
  messages::BeliefSummary summary_;
  std::array<ActionOutlook, config::kMaxActions> outlooks_;
};

static_assert(sizeof(Belief) <= config::kBeliefBytes);

}  // namespace earshot::policy
