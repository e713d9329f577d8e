#include "firmware/policy/ocean_belief/measurement_weigher.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/ocean_belief/hypotheses/cell_places.hpp"
#include "firmware/policy/ocean_belief/hypotheses/each_drift.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

namespace earshot::policy {

void MeasurementWeigher::weigh(const Assumptions& assumed, const Measurement& measurement, std::uint32_t index, HypothesisBlock& block) {
  weigh_snr(assumed, measurement, index, block);
  if (measurement.was_declared) rule_out(assumed, measurement.position, index, block);
}

/// By itself, so that its places are gone from the stack when others are found by which to rule out.
[[gnu::noinline]] void MeasurementWeigher::weigh_snr(const Assumptions& assumed, const Measurement& measurement, std::uint32_t index,
                                                     HypothesisBlock& block) {
  const BeliefModel& model = assumed.model;
  const OceanTables& tables = assumed.tables;
  Meters drifted{0.0};
  for (const Hypothesis& h : block.hypotheses()) drifted = std::max(drifted, length_of(way_of(current_of(h), model, index)));
  const std::size_t ranges = ranges_to_all(model, measurement.position, drifted, tables.range_step, tables.range_count);
  likelihoods_.tabulate(model, tables, block.hypotheses(), {.snr = measurement.snr, .too_faint = measurement.too_faint}, ranges);
  CellPlaces places;
  for_each_drift(block, [&](const Drift& drift, const Lanes& lanes) {
    places.find(model, drift, index, {});
    places.find_ranges(model, measurement.position, tables.range_step, ranges - 1, ranges_);
    block.weigh(model, lanes, likelihoods_.raised_by_range(), ranges_);
  });
}

void MeasurementWeigher::rule_out(const Assumptions& assumed, NorthEast position, std::uint32_t index, HypothesisBlock& block) {
  const BeliefModel& model = assumed.model;
  const Meters range_step = assumed.tables.range_step;
  const std::size_t count = assumed.tables.range_count;
  std::array<float, config::kMaxTableRanges> uncovered;
  std::array<std::int16_t, config::kMaxTableRanges> logs;
  find_uncovered(model, range_step, std::span(uncovered).first(count));
  to_logs(std::span(uncovered).first(count), kForgotten, std::span(logs).first(count));
  CellPlaces places;
  for_each_drift(block, [&](const Drift& drift, const Lanes& lanes) {
    places.find(model, drift, index, {});
    places.find_ranges(model, position, range_step, count - std::size_t{1}, ranges_);
    for (std::size_t i = 0; i < cell_count(model); ++i) by_cell_[i] = logs[ranges_[i]];
    block.weigh_places(model, lanes, by_cell_);
  });
}

BearingWeights MeasurementWeigher::bearing_weights(const BeliefModel& model, const Measurement& measurement) {
  return find_bearing_weights(model, measurement, std::span(by_cell_).first(cell_count(model)));
}

}  // namespace earshot::policy
