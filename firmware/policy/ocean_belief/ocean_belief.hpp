#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/messages/belief_summary.hpp"
#include "firmware/messages/found_declaration.hpp"
#include "firmware/policy/action_values/action_values.hpp"
#include "firmware/policy/belief/belief_model.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/found/found_rule.hpp"
#include "firmware/policy/ocean_belief/hypotheses/candidates.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis_block.hpp"
#include "firmware/policy/ocean_belief/hypotheses/lane_likelihoods.hpp"
#include "firmware/policy/ocean_belief/model_mismatch.hpp"
#include "firmware/policy/ocean_belief/silence.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

/// Probability of the source's place together with that of the hypotheses about ocean, level, fluctuation, pauses and motion, in fixed
/// memory.
///
/// There are thousands of hypotheses, each with a grid of its own; only the likeliest are held. The others are drawn, a few between every
/// two measurements, weighed by all that was heard since the start, and take the place of one that is less likely.
class OceanBelief {
 public:
  /// Forgets everything: every place is as likely as any other.
  /// @param tables  at least one
  void start(const BeliefModel& model, const OceanTables& tables);
  /// Takes in what was heard at `position` (relative to the area's south-west corner), and judges whether the source is found there. If it
  /// is, all else that is said afterwards is of a search that goes on nevertheless: that the source is not within step_length.
  void update(const BeliefModel& model, const OceanTables& tables, NorthEast position, Reception reception);

  /// Weighs others for a slice of time (README.md), as a vehicle does between two decisions whenever it can. What is left of it the next
  /// update() does first: what is believed after that does not depend on who refined them when, or in which slices. Nothing that the last
  /// update() said of place, mismatch and action values changes. @return whether anything is left
  bool refine(const BeliefModel& model, const OceanTables& tables);

  /// That the source is found (firmware/policy/found), by all that was heard up to the last measurement; nothing where it is not.
  [[nodiscard]] const std::optional<messages::FoundDeclaration>& declaration() const { return declaration_; }
  /// Places are relative to the area's south-west corner.
  [[nodiscard]] const messages::BeliefSummary& summary() const { return summary_; }
  /// @param action  below the number of the model's actions
  [[nodiscard]] const ActionValues& action_values(std::size_t action) const { return action_values_[action]; }
  /// Probability that the source lies in a cell, counted from the south and from the west.
  [[nodiscard]] float probability(const BeliefModel& model, std::size_t north, std::size_t east) const {
    return marginal_[north * model.cells_east + east];
  }

  static constexpr std::size_t kHypotheses = kHeldHypotheses;
  /// @param index  below kHypotheses
  [[nodiscard]] const Hypothesis& hypothesis(std::size_t index) const { return retained_[index / kLanes].hypothesis(index % kLanes); }
  /// Probability of one of the hypotheses that are held; these add up to one.
  [[nodiscard]] float share(std::size_t index) const { return shares_[index / kLanes][index % kLanes]; }
  /// How unlikely what was heard is under every hypothesis that is held.
  [[nodiscard]] const ModelMismatch& model_mismatch() const { return model_mismatch_; }
  /// How unlikely it is that nothing was detected for so long; what the last measurement says against the tables once it is refined.
  [[nodiscard]] const Silence& silence() const { return silence_; }
  /// Whether, after the last update(), the vehicle had better sweep the area: what it hears fits no hypothesis, or it has heard nothing for
  /// long, against the tables up to the measurement before.
  [[nodiscard]] bool calls_for_sweep() const { return calls_for_sweep_; }
  /// Adds the probability of every cell together with that of one of the hypotheses that are held.
  /// @param joint  [north x east]
  void add_joint(const BeliefModel& model, std::size_t index, std::span<float> joint) const;
  /// CRC-32 of all that is believed of places, bit for bit: weights, their sum over the hypotheses, and what each action expects of it.
  [[nodiscard]] std::uint32_t fingerprint(const BeliefModel& model) const;

 private:
  /// A bearing, in little memory.
  struct PastBearing {
    float direction;
    float deviation;  ///< 0: there is none
    float mirror_axis;
    [[nodiscard]] bool is_there() const { return deviation > 0.0F; }
    /// That which is there.
    [[nodiscard]] messages::Bearing bearing() const;
  };
  struct Measurement {
    NorthEast position;
    Decibels snr;
    PastBearing bearing;
    bool too_faint;
    bool was_declared;  ///< the source found there, and was not
  };

  [[nodiscard]] static PastBearing to_remember(const std::optional<messages::Bearing>& bearing);
  [[nodiscard]] int find_bearing_likelihood(const BeliefModel& model, const Measurement& measurement);
  void take_in_bearing(const BeliefModel& model, const Measurement& measurement);
  void take_in_past_bearing(const BeliefModel& model, const Measurement& measurement, std::uint32_t index);
  void weigh_bearing(const BeliefModel& model, const Measurement& measurement, int taken_off, std::uint32_t index, HypothesisBlock& block);
  void take_in(const BeliefModel& model, const OceanTables& tables, const Measurement& measurement, std::uint32_t index,
               HypothesisBlock& block);
  void weigh_snr(const BeliefModel& model, const OceanTables& tables, const Measurement& measurement, std::uint32_t index,
                 HypothesisBlock& block);
  void rule_out(const BeliefModel& model, const OceanTables& tables, NorthEast position, std::uint32_t index, HypothesisBlock& block);
  [[nodiscard]] Decibels least_snr_near(const BeliefModel& model, const OceanTables& tables) const;
  void judge(const BeliefModel& model, const OceanTables& tables, NorthEast position, const Reception& reception);
  [[nodiscard]] int posterior(std::size_t index) const { return posteriors_[index / kLanes][index % kLanes]; }
  void find_posteriors(const BeliefModel& model, const OceanTables& tables);
  void find_shares();
  [[nodiscard]] int log_explained(const BeliefModel& model, const OceanTables& tables) const;
  [[nodiscard]] HeldHypotheses held() const;
  void draw_candidates(const BeliefModel& model, const OceanTables& tables);
  [[nodiscard]] bool is_held(const Hypothesis& hypothesis) const;
  [[nodiscard]] std::size_t least_likely(bool drifts) const;
  [[nodiscard]] std::size_t drifting() const;
  [[nodiscard]] int least_to_be_held(bool drifts) const;
  [[nodiscard]] int posterior_of_likeliest() const;
  [[nodiscard]] int most_to_come(const BeliefModel& model, const OceanTables& tables, int to_measure) const;
  void take_the_likelier(const BeliefModel& model, const OceanTables& tables);
  [[nodiscard]] Drift likeliest_current() const;
  void find_marginal(const BeliefModel& model, NorthEast corner, std::uint32_t measurements, const CellWindow& window);
  std::size_t foresee(const BeliefModel& model, const OceanTables& tables, NorthEast position);
  void find_regrets(const BeliefModel& model, NorthEast position);
  [[nodiscard]] float expected_detection(const BeliefModel& model, NorthEast position) const;

  using Posteriors = std::array<int, kLanes>;  ///< log2 of what is proportional to the probability of each hypothesis, in 1/512

  std::array<HypothesisBlock, config::kBeliefBlocks> retained_;
  std::array<Posteriors, config::kBeliefBlocks> posteriors_;
  std::array<FloatLanes, config::kBeliefBlocks> shares_;
  HypothesisBlock candidates_;
  std::uint32_t candidates_heard_;  ///< measurements that the candidates have taken in
  bool has_candidates_;
  std::size_t to_weigh_;  ///< measurements of others that are left to be weighed on the last measurement
  std::uint32_t heard_;   ///< measurements so far
  bool has_bearings_;     ///< one at least
  FixedVector<Measurement, config::kMaxBeliefMeasurements> measurements_;
  bool is_history_whole_;  ///< every measurement is in it
  Pcg32 random_{0};
  ModelMismatch model_mismatch_;
  Silence silence_;
  NorthEast listened_at_;  ///< the last measurement
  bool calls_for_sweep_;
  PlacePrior bearings_;                                        ///< what all bearings say together
  std::array<std::int16_t, config::kMaxBeliefCells> by_cell_;  ///< [north x east], what one says, or a declaration
  LaneLikelihoods likelihoods_;
  std::array<std::uint16_t, config::kMaxBeliefCells> ranges_;  ///< [north x east], from the vehicle, in range steps
  std::array<float, config::kMaxBeliefCells> marginal_;        ///< [north x east], sum over the hypotheses
  std::array<RangeSample, config::kMaxTableRanges> foreseen_;
  FoundRule found_rule_;
  std::optional<messages::FoundDeclaration> declaration_;
  messages::BeliefSummary summary_;
  std::array<ActionValues, config::kMaxActions> action_values_;
};

static_assert(sizeof(OceanBelief) + sizeof(OceanTables) <= config::kOceanBeliefBytes);

}  // namespace earshot::policy
