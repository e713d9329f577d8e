#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/messages/belief_summary.hpp"
#include "firmware/messages/found_declaration.hpp"
#include "firmware/policy/action_values/action_values.hpp"
#include "firmware/policy/belief/belief_model.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/ocean_belief/action_assessment.hpp"
#include "firmware/policy/ocean_belief/bearings.hpp"
#include "firmware/policy/ocean_belief/hypotheses/assumptions.hpp"
#include "firmware/policy/ocean_belief/hypotheses/retained_hypotheses.hpp"
#include "firmware/policy/ocean_belief/judgement.hpp"
#include "firmware/policy/ocean_belief/measurement_history.hpp"
#include "firmware/policy/ocean_belief/measurement_weigher.hpp"
#include "firmware/policy/ocean_belief/model_mismatch.hpp"
#include "firmware/policy/ocean_belief/replacement.hpp"
#include "firmware/policy/ocean_belief/silence.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

/// Probability of the source's place together with that of the hypotheses about ocean, level, fluctuation, pauses and motion, in fixed
/// memory. It owns what all hypotheses together mean for the place, and the objects that do the rest, which it calls in their order.
///
/// There are thousands of hypotheses, each with a grid of its own; only the likeliest are retained. The others are drawn, a few between
/// every two measurements, weighed by all that was heard since the start, and take the place of one that is less likely.
class OceanBelief {
 public:
  /// Forgets everything: every place is as likely as any other.
  /// @param tables  at least one
  void start(const BeliefModel& model, const OceanTables& tables);
  /// Takes in what was heard at `position` (relative to the area's south-west corner), and judges whether the source is found there. If it
  /// is, all else that is said afterwards is of a search that goes on nevertheless: that the source is not within step_length.
  /// @param reception  an SNR or a bound below -30 dB, or below the detection threshold if that is less, counts as too faint for that
  void update(const BeliefModel& model, const OceanTables& tables, NorthEast position, Reception reception);

  /// Weighs others for a slice of time (README.md), as a vehicle does between two decisions whenever it can. What is left of it the next
  /// update() does first: what is believed after that does not depend on who refined them when, or in which slices. Nothing that the last
  /// update() said of place, mismatch and action values changes. @return whether anything is left
  bool refine(const BeliefModel& model, const OceanTables& tables);

  /// That the source is found (firmware/policy/found), by all that was heard up to the last measurement; nothing where it is not.
  [[nodiscard]] const std::optional<messages::FoundDeclaration>& declaration() const { return judgement_.declaration(); }
  /// Places are relative to the area's south-west corner.
  [[nodiscard]] const messages::BeliefSummary& summary() const { return summary_; }
  /// @param action  below the number of the model's actions
  [[nodiscard]] const ActionValues& action_values(std::size_t action) const { return assessment_.values()[action]; }
  /// Probability that the source lies in a cell, counted from the south and from the west.
  [[nodiscard]] float probability(const BeliefModel& model, std::size_t north, std::size_t east) const {
    return marginal_[north * model.cells_east + east];
  }

  static constexpr std::size_t kHypotheses = kRetainedHypotheses;
  /// @param index  below kHypotheses
  [[nodiscard]] const Hypothesis& hypothesis(std::size_t index) const { return retained_.hypothesis(index); }
  /// Probability of one of the retained hypotheses; these add up to one.
  [[nodiscard]] float share(std::size_t index) const { return retained_.share(index); }
  /// How unlikely what was heard is under every retained hypothesis.
  [[nodiscard]] const ModelMismatch& model_mismatch() const { return model_mismatch_; }
  /// How unlikely it is that nothing was detected for so long; what the last measurement says against the tables once it is refined.
  [[nodiscard]] const Silence& silence() const { return silence_; }
  /// Whether, after the last update(), the vehicle had better sweep the area: what it hears fits no hypothesis, or it has heard nothing for
  /// long, against the tables up to the measurement before.
  [[nodiscard]] bool calls_for_sweep() const { return calls_for_sweep_; }
  /// Adds the probability of every cell together with that of one of the retained hypotheses.
  /// @param joint  [north x east]
  void add_joint(const BeliefModel& model, std::size_t index, std::span<float> joint) const {
    retained_.add_joint(model, index, history_.count(), joint);
  }
  /// CRC-32 of all that is believed of places, bit for bit: weights, their sum over the hypotheses, and what each action expects of it.
  [[nodiscard]] std::uint32_t fingerprint(const BeliefModel& model) const;

 private:
  void take_in(const Assumptions& assumed, const Measurement& measurement, std::uint32_t index);
  void take_in_bearing(const BeliefModel& model, const Measurement& measurement, std::uint32_t index);
  void judge(const Assumptions& assumed, NorthEast position, const Reception& reception, std::uint32_t index);
  void sum_up(const Assumptions& assumed, NorthEast position);
  [[nodiscard]] std::span<float> marginal(const BeliefModel& model) { return std::span(marginal_).first(cell_count(model)); }

  MeasurementHistory history_;
  RetainedHypotheses retained_;
  Replacement replacement_;
  MeasurementWeigher weigher_;
  Judgement judgement_;
  ActionAssessment assessment_;
  Silence silence_;
  messages::BeliefSummary summary_;
  BearingSum bearings_;
  ModelMismatch model_mismatch_;
  /// [north x east], sum over the hypotheses. Without initial values: start() writes the cells that there are, and zeros would take flash
  /// and time.
  std::array<float, config::kMaxBeliefCells> marginal_;
  bool calls_for_sweep_ = false;
};

static_assert(sizeof(OceanBelief) + sizeof(OceanTables) <= config::kOceanBeliefBytes);

}  // namespace earshot::policy
