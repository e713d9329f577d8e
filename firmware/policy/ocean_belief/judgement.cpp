// When an OceanBelief says that the source is found, and what it makes of a search that goes on nevertheless.

#include <algorithm>

#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/ocean_belief/hypotheses/cell_places.hpp"
#include "firmware/policy/ocean_belief/hypotheses/each_drift.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"
#include "firmware/policy/ocean_belief/ocean_belief.hpp"

namespace earshot::policy {
namespace {

/// Standard deviations below what is expected that a source is still taken to be heard as it should be.
constexpr float kFainter = 2.0F;

}  // namespace

/// The source is not within a step length of the vehicle at that measurement.
void OceanBelief::rule_out(const BeliefModel& model, const OceanTables& tables, NorthEast position, std::uint32_t index,
                           HypothesisBlock& block) {
  const std::size_t count = tables.range_count;
  std::array<float, config::kMaxTableRanges> uncovered;
  std::array<std::int16_t, config::kMaxTableRanges> logs;
  find_uncovered(model, tables.range_step, std::span(uncovered).first(count));
  to_logs(std::span(uncovered).first(count), kForgotten, std::span(logs).first(count));
  CellPlaces places;
  for_each_drift(block, [&](const Drift& drift, const Lanes& lanes) {
    places.find(model, drift, index, {});
    places.find_ranges(model, position, tables.range_step, count - std::size_t{1}, ranges_);
    for (std::size_t i = 0; i < cell_count(model); ++i) by_cell_[i] = logs[ranges_[i]];
    block.weigh_places(model, lanes, by_cell_);
  });
}

/// The least SNR that is expected within a step length of the source, as the hypotheses say by their shares.
Decibels OceanBelief::least_snr_near(const BeliefModel& model, const OceanTables& tables) const {
  const auto at = std::min(static_cast<std::size_t>(model.step_length / tables.range_step), tables.range_count - std::size_t{1});
  float sum_db = 0.0F;
  for (std::size_t i = 0; i < kHypotheses; ++i) {
    const Hypothesis& h = hypothesis(i);
    sum_db += share(i) * (tables.tables[h.table].snr_db(at) + kLevelOffsets_db[h.level] - kFainter * kSpreads_db[h.spread]);
  }
  return Decibels{double{sum_db}};
}

/// By where the source was at the last measurement. Where it is declared found, what follows is for a search that goes on nevertheless: the
/// source is elsewhere.
void OceanBelief::judge(const BeliefModel& model, const OceanTables& tables, NorthEast position, const Reception& reception) {
  declaration_.reset();
  const Decibels least_snr = least_snr_near(model, tables);
  if (!FoundRule::is_heard_near(reception, least_snr)) return;
  const std::uint32_t index = heard_ - 1;
  const NorthEast corner = way_of(likeliest_current(), model, index);
  const NorthEast from_corner = position - corner;
  const std::span<const float> probabilities = std::span(marginal_).first(cell_count(model));
  find_marginal(model, corner, index, cells_near(model, from_corner));
  const float probability = probability_within(model, probabilities, from_corner);
  const std::uint32_t near_measurements = found_rule_.judge({.probability = probability, .reception = reception, .least_snr = least_snr});
  if (near_measurements == 0) return;
  find_marginal(model, corner, index, all_cells(model));
  const auto likeliest = std::max_element(probabilities.begin(), probabilities.end());
  const NorthEast way = way_to_cell(model, from_corner, static_cast<std::size_t>(likeliest - probabilities.begin()));
  declaration_ = messages::FoundDeclaration{.probability = probability,
                                            .snr = reception.snr,
                                            .least_snr = least_snr,
                                            .likeliest = from_corner + way + corner,
                                            .closest_approach = length_of(way),
                                            .measurement = index,
                                            .near_measurements = near_measurements};
  if (is_history_whole_) measurements_[measurements_.size() - 1].was_declared = true;  // those that have not heard it yet will
  for (HypothesisBlock& block : retained_) rule_out(model, tables, position, index, block);
  find_posteriors(model, tables);
  find_shares();
}

}  // namespace earshot::policy
