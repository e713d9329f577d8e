#include "firmware/policy/ocean_belief/action_assessment.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/likelihood/normal_table.hpp"
#include "firmware/policy/ocean_belief/expected_border.hpp"

namespace earshot::policy {
namespace {

/// More than any regret.
constexpr float kAnyRegret = 1e9F;
/// Further than any vehicle gets.
constexpr double kAnyRange_m = 1e9;
/// What it costs to go back to where the vehicle measured before, in steps on which nothing is detected, for each time that it did; ends of
/// steps within so many step lengths of one another are one place.
constexpr float kCostOfReturn = 10.0F;
constexpr double kSamePlace = 0.25;

}  // namespace

void ActionAssessment::start() {
  values_ = {};
  position_ = {};
}

void ActionAssessment::find(const Assumptions& assumed, const RetainedHypotheses& retained, const MeasurementHistory& history,
                            NorthEast position, NorthEast corner, std::span<const float> marginal) {
  const BeliefModel& model = assumed.model;
  position_ = position;
  const std::size_t ranges = tabulate(assumed, retained, position - corner);
  BeliefModel not_cut_off = model;
  not_cut_off.costs.most_regret = kAnyRegret;
  find_action_values(not_cut_off, marginal, {std::span(by_range_).first(ranges), assumed.tables.range_step}, position - corner,
                     std::span(values_).first(model.actions.size()));
  find_regrets(model, retained, history, position);
}

/// Tabulates by range what a search that goes straight to a source costs, under the hypotheses as likely as they now are.
/// @param position  of the vehicle, from the area's corner   @return how many ranges: no way to a source is longer
EARSHOT_WIDE std::size_t ActionAssessment::tabulate(const Assumptions& assumed, const RetainedHypotheses& retained, NorthEast position) {
  const BeliefModel& model = assumed.model;
  const OceanTables& tables = assumed.tables;
  const std::size_t half = half_cell(model, tables.range_step, tables.range_count);
  // A way begins a step away and may end a step later; where the border is wider than the area, it ends outside.
  const Meters outside =
      std::max(Meters{0.0}, model.border_width - model.area_size.north) + std::max(Meters{0.0}, model.border_width - model.area_size.east);
  const std::size_t ranges = ranges_to_all(model, position, 2.0 * model.step_length + outside, tables.range_step, tables.range_count);
  const std::size_t count = std::min(ranges + half, std::size_t{tables.range_count});  // what a cell at the last range lies at as well
  std::array<float, config::kMaxTableRanges> over_all{};
  std::array<float, config::kMaxTableRanges> detected;  // under one hypothesis, then under all
  for (std::size_t i = 0; i < kRetainedHypotheses; ++i) {
    if (retained.share(i) < kLeastShare) continue;
    const Hypothesis& h = retained.hypothesis(i);
    const OceanTable& table = tables.tables[h.table];
    const float per_spread = 1.0F / kSpreads_db[h.spread];
    const float level = kLevelOffsets_db[h.level] - static_cast<float>(model.detection_threshold.value);
    const float sounding = (1.0F - kSilenceShares[h.silence]) * retained.share(i);
    for (std::size_t r = 0; r < count; ++r) detected[r] = (table.snr_db(r) + level) * per_spread;
    to_normal_cumulative(std::span(detected).first(count));
    for (std::size_t r = 0; r < count; ++r) over_all[r] += sounding * detected[r];
  }
  smooth(std::span(over_all).first(count), half, std::span(detected).first(count));
  const std::span<float> search_cost = std::span(over_all).first(ranges);
  find_search_cost(model, tables.range_step, exp(model.costs.log_step_discount), std::span(detected).first(ranges), search_cost);
  find_samples(search_cost, std::span(detected).first(ranges), std::span(by_range_).first(ranges));
  return ranges;
}

/// What all of it costs, counted from the least. A vehicle that has been at a place without finding the source gains nothing by going back
/// and forth between two of them: that looks cheap at every step where the way to the source is by way of the border.
void ActionAssessment::find_regrets(const BeliefModel& model, const RetainedHypotheses& retained, const MeasurementHistory& history,
                                    NorthEast position) {
  std::array<PossiblePlace, kRetainedHypotheses> places;
  for (std::size_t i = 0; i < kRetainedHypotheses; ++i) {
    const Drift current = current_of(retained.hypothesis(i));
    places[i] = {.vehicle = position - way_of(current, model, history.count()), .share = retained.share(i)};
  }
  const std::span<ActionValues> values = std::span(values_).first(model.actions.size());
  expect_border(model, places, values);
  float least = kAnyRegret;
  for (std::size_t a = 0; a < values.size(); ++a) {
    const NorthEast end = position + model.step_length * model.actions[a];
    values[a].regret += kCostOfReturn * static_cast<float>(history.visits(end, kSamePlace * model.step_length));
    least = std::min(least, values[a].regret);
  }
  for (ActionValues& of : values) of.regret = std::min(of.regret - least, model.costs.most_regret);
}

float ActionAssessment::expected_detection(const BeliefModel& model, NorthEast position) const {
  float expected = 0.0F;
  Meters nearest{kAnyRange_m};
  for (std::size_t a = 0; a < model.actions.size(); ++a) {
    const Meters range = range_between(position_ + model.step_length * model.actions[a], position);
    if (range < nearest) expected = values_[a].detected;
    nearest = std::min(nearest, range);
  }
  return expected;
}

}  // namespace earshot::policy
