#include "firmware/policy/ocean_belief/ocean_belief.hpp"

#include <algorithm>
#include <bit>

#include "firmware/core/crc32.hpp"
#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"
#include "firmware/policy/belief/belief_summary.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/likelihood/normal_table.hpp"
#include "firmware/policy/ocean_belief/expected_border.hpp"
#include "firmware/policy/ocean_belief/hypotheses/cell_places.hpp"
#include "firmware/policy/ocean_belief/hypotheses/each_drift.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

namespace earshot::policy {
namespace {

/// A hypothesis less likely than this changes no decision.
constexpr float kLeastShare = 1e-4F;
/// More than any regret.
constexpr float kAnyRegret = 1e9F;
/// Further than any vehicle gets.
constexpr double kAnyRange_m = 1e9;
/// Between two measurements of the vehicle so many of blocks of eight others are weighed at most. With 50 fewer sources are found
/// (README.md), with 400 no more than with 200.
constexpr std::size_t kMeasurementsOfOthers = 200;
/// What it costs to go back to where the vehicle listened before, in steps on which nothing is detected, for each time that it did; ends of
/// steps within so many step lengths of one another are one place.
constexpr float kCostOfReturn = 10.0F;
constexpr double kSamePlace = 0.25;
/// Powers of two below the likeliest at which a hypothesis has no share.
constexpr int kMostBelow = 60 * kOctave;

/// The n-th to begin with, the likeliest first: all oceans as they are, then louder, fainter, and so on; fit for more than are ever held.
Hypothesis at_start(const OceanTables& tables, std::size_t n) {
  constexpr std::array<std::uint8_t, kLevelOffsets_db.size()> kLevels{3, 5, 1, 4, 2, 6, 0};
  constexpr std::array<std::uint8_t, kSpreads_db.size()> kSpreads{2, 1, 3, 0};
  static_assert(kLevels.size() * kSpreads.size() >= OceanBelief::kHypotheses, "even with one ocean");
  const std::size_t way = n / tables.tables.size();
  return {.table = static_cast<std::uint8_t>(n % tables.tables.size()),
          .level = kLevels[way % kLevels.size()],
          .spread = kSpreads[way / kLevels.size() % kSpreads.size()]};
}

/// None where the source swims.
Drift current_of(const Hypothesis& hypothesis) {
  return hypothesis.drift.is_current ? hypothesis.drift : Drift{};
}

}  // namespace

void OceanBelief::start(const BeliefModel& model, const OceanTables& tables) {
  random_ = Pcg32(1);
  measurements_.clear();
  is_history_whole_ = true;
  has_candidates_ = false;
  to_weigh_ = 0;
  heard_ = 0;
  has_bearings_ = false;
  found_rule_.start();
  declaration_.reset();
  model_mismatch_.start();
  silence_.start();
  calls_for_sweep_ = false;
  std::fill_n(bearings_.log_weights.begin(), cell_count(model), std::int16_t{0});
  bearings_.scale = 0;
  std::uint8_t likeliest = 0;
  for (std::uint8_t k = 0; k < tables.tables.size(); ++k)
    likeliest = tables.tables[k].prior > tables.tables[likeliest].prior ? k : likeliest;
  // The likeliest ocean in every way that is not rare, and as many others as there is room for.
  std::array<Hypothesis, kLanes> hypotheses;
  hypotheses.fill({.table = likeliest});
  hypotheses[1].spread = 1;
  hypotheses[2].spread = 0;
  hypotheses[3].level = 1;
  hypotheses[4].level = 5;
  hypotheses[5].silence = 1;
  hypotheses[6].mobility = 1;
  hypotheses[7].spread = 3;
  for (HypothesisBlock& block : retained_) block.start(model, hypotheses, bearings_);
  std::size_t next = 0;
  for (std::size_t b = 1; b < retained_.size(); ++b) {
    for (Hypothesis& h : hypotheses) {
      do h = at_start(tables, next++);
      while (retained_[0].holds(h));  // one that is held twice would count twice
    }
    retained_[b].start(model, hypotheses, bearings_);
  }
  std::fill_n(marginal_.begin(), cell_count(model), 1.0F / static_cast<float>(cell_count(model)));
  find_posteriors(model, tables);
  find_shares();
  summary_ = {};
  action_values_ = {};
}

void OceanBelief::update(const BeliefModel& model, const OceanTables& tables, NorthEast position, Reception reception) {
  while (refine(model, tables)) {
  }
  silence_.take_in(model, position, reception, expected_detection(model, position));
  listened_at_ = position;
  const Measurement measurement{.position = position,
                                .snr = reception.snr,
                                .bearing = to_remember(reception.bearing),
                                .too_faint = reception.too_faint,
                                .was_declared = false};
  is_history_whole_ = measurements_.push_back(measurement) == Status::kOk && is_history_whole_;
  for (HypothesisBlock& block : retained_) block.let_move(model);  // since the last measurement: bearing and SNR are of where it is now
  if (measurement.bearing.is_there()) take_in_bearing(model, measurement);
  for (HypothesisBlock& block : retained_) take_in(model, tables, measurement, heard_, block);
  ++heard_;
  find_posteriors(model, tables);
  find_shares();
  to_weigh_ = is_history_whole_ ? kMeasurementsOfOthers : 0;
  model_mismatch_.take_in(reception, log_explained(model, tables));
  judge(model, tables, position, reception);
  // Where the source is by the next measurement, from the corner of the area as the likeliest current has carried it.
  const NorthEast corner = way_of(likeliest_current(), model, heard_);
  find_marginal(model, corner, heard_, all_cells(model));
  const std::size_t ranges = foresee(model, tables, position - corner);
  const std::span<const float> probabilities = std::span(marginal_).first(cell_count(model));
  summary_ = summary_of(model, probabilities);
  summary_.mismatch_bits = model_mismatch_.bits();
  summary_.likeliest = summary_.likeliest + corner;
  summary_.mean = summary_.mean + corner;
  BeliefModel not_cut_off = model;
  not_cut_off.costs.most_regret = kAnyRegret;
  find_action_values(not_cut_off, probabilities, {std::span(foreseen_).first(ranges), tables.range_step}, position - corner,
                     std::span(action_values_).first(model.actions.size()));
  find_regrets(model, position);
  calls_for_sweep_ = model_mismatch_.calls_for_sweep() || silence_.is_long();
}

/// What all of it costs, counted from the least. A vehicle that has been at a place without finding the source gains nothing by going back
/// and forth between two of them: that looks cheap at every step where the way to the source is by way of the border.
void OceanBelief::find_regrets(const BeliefModel& model, NorthEast position) {
  std::array<PossiblePlace, kHypotheses> places;
  for (std::size_t i = 0; i < kHypotheses; ++i) {
    const Drift current = current_of(hypothesis(i));
    places[i] = {.vehicle = position - way_of(current, model, heard_), .share = share(i)};
  }
  const std::span<ActionValues> action_values = std::span(action_values_).first(model.actions.size());
  expect_border(model, places, action_values);
  float least = kAnyRegret;
  for (std::size_t a = 0; a < action_values.size(); ++a) {
    const NorthEast end = position + model.step_length * model.actions[a];
    const auto visits = std::count_if(measurements_.begin(), measurements_.end(), [&](const Measurement& measurement) {
      return range_between(measurement.position, end) < kSamePlace * model.step_length;
    });
    action_values[a].regret += kCostOfReturn * static_cast<float>(visits);
    least = std::min(least, action_values[a].regret);
  }
  for (ActionValues& values : action_values) values.regret = std::min(values.regret - least, model.costs.most_regret);
}

/// What a measurement says of the source where it is now. @param index  of the measurement, counted from 0
void OceanBelief::take_in(const BeliefModel& model, const OceanTables& tables, const Measurement& measurement, std::uint32_t index,
                          HypothesisBlock& block) {
  weigh_snr(model, tables, measurement, index, block);
  if (measurement.was_declared) rule_out(model, tables, measurement.position, index, block);
}

/// By itself, so that its places are gone from the stack when others are found by which to rule out.
[[gnu::noinline]] void OceanBelief::weigh_snr(const BeliefModel& model, const OceanTables& tables, const Measurement& measurement,
                                              std::uint32_t index, HypothesisBlock& block) {
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

void OceanBelief::find_posteriors(const BeliefModel& model, const OceanTables& tables) {
  for (std::size_t b = 0; b < retained_.size(); ++b) {
    posteriors_[b] = retained_[b].log_evidence(model);
    for (std::size_t l = 0; l < kLanes; ++l) posteriors_[b][l] += log_prior(retained_[b].hypothesis(l), tables);
  }
}

void OceanBelief::find_shares() {
  const int highest = posterior_of_likeliest();
  float sum = 0.0F;
  for (std::size_t b = 0; b < retained_.size(); ++b) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      shares_[b][l] = from_log(std::max(posteriors_[b][l] - highest, -kMostBelow));
      sum += shares_[b][l];
    }
  }
  for (FloatLanes& shares : shares_) {
    for (float& share : shares) share /= sum;
  }
}

/// log2 of the probability of all that was heard, explanations with a prior penalty counting for less.
int OceanBelief::log_explained(const BeliefModel& model, const OceanTables& tables) const {
  std::array<int, kHypotheses> explanations;
  for (std::size_t i = 0; i < kHypotheses; ++i)
    explanations[i] = posteriors_[i / kLanes][i % kLanes] - log_prior_of_ocean(hypothesis(i), tables) - log_prior(hypothesis(i).drift) -
                      prior_penalty(hypothesis(i));
  return log_of_sum(explanations) - to_log(static_cast<float>(cell_count(model)));
}

/// The current that is the likeliest of all; none where it is likelier that there is none.
Drift OceanBelief::likeliest_current() const {
  float most = 0.0F;
  Drift likeliest;
  for (std::size_t i = 0; i < kHypotheses; ++i) {
    const Drift current = current_of(hypothesis(i));
    std::size_t first = 0;
    while (!(current_of(hypothesis(first)) == current)) ++first;
    if (first < i) continue;  // it has been summed up
    float sum = 0.0F;
    for (std::size_t k = i; k < kHypotheses; ++k) sum += current_of(hypothesis(k)) == current ? share(k) : 0.0F;
    if (sum > most) likeliest = current;
    most = std::max(most, sum);
  }
  return likeliest;
}

/// Sums up where the source is after so many measurements, from a corner that has drifted; nothing outside the window.
void OceanBelief::find_marginal(const BeliefModel& model, NorthEast corner, std::uint32_t measurements, const CellWindow& window) {
  const std::span<float> marginal = std::span(marginal_).first(cell_count(model));
  bool is_first = true;
  const auto clear = [&] {
    if (is_first) std::fill(marginal.begin(), marginal.end(), 0.0F);
    is_first = false;
  };
  if (window != all_cells(model)) clear();
  CellPlaces places;
  std::array<std::uint16_t, CellPlaces::kMostAxes> axes;
  for (std::size_t b = 0; b < retained_.size(); ++b) {
    FloatLanes at_rest{};
    float most_at_rest = 0.0F;
    for (std::size_t l = 0; l < kLanes; ++l) {
      const Drift& drift = retained_[b].hypothesis(l).drift;
      if (drift.is_none() && corner == NorthEast{}) {
        at_rest[l] = shares_[b][l];
        most_at_rest = std::max(most_at_rest, at_rest[l]);
      } else if (shares_[b][l] >= kLeastShare) {
        places.find(model, drift, measurements, corner);
        places.find_axes(model, axes);
        clear();
        retained_[b].add_to(model, l, shares_[b][l], axes, window, marginal);
      }
    }
    if (most_at_rest < kLeastShare) continue;
    retained_[b].add_to(model, at_rest, window, is_first, marginal);
    is_first = false;
  }
  clear();
}

/// Tabulates by range what a search that goes straight to a source costs, under the hypotheses as likely as they now are.
/// @param position  of the vehicle, from the area's corner   @return how many ranges: no way to a source is longer
EARSHOT_WIDE std::size_t OceanBelief::foresee(const BeliefModel& model, const OceanTables& tables, NorthEast position) {
  const std::size_t half = half_cell(model, tables.range_step, tables.range_count);
  // A way begins a step away and may end a step later; where the border is wider than the area, it ends outside.
  const Meters outside =
      std::max(Meters{0.0}, model.border_width - model.area_size.north) + std::max(Meters{0.0}, model.border_width - model.area_size.east);
  const std::size_t ranges = ranges_to_all(model, position, 2.0 * model.step_length + outside, tables.range_step, tables.range_count);
  const std::size_t count = std::min(ranges + half, std::size_t{tables.range_count});  // what a cell at the last range lies at as well
  std::array<float, config::kMaxTableRanges> over_all{};
  std::array<float, config::kMaxTableRanges> detected;  // under one hypothesis, then under all
  for (std::size_t i = 0; i < kHypotheses; ++i) {
    if (share(i) < kLeastShare) continue;
    const Hypothesis& h = hypothesis(i);
    const OceanTable& table = tables.tables[h.table];
    const float per_spread = 1.0F / kSpreads_db[h.spread];
    const float level = kLevelOffsets_db[h.level] - static_cast<float>(model.detection_threshold.value);
    const float sounding = (1.0F - kSilenceShares[h.silence]) * share(i);
    for (std::size_t r = 0; r < count; ++r) detected[r] = (table.snr_db(r) + level) * per_spread;
    to_normal_cumulative(std::span(detected).first(count));
    for (std::size_t r = 0; r < count; ++r) over_all[r] += sounding * detected[r];
  }
  smooth(std::span(over_all).first(count), half, std::span(detected).first(count));
  const std::span<float> search_cost = std::span(over_all).first(ranges);
  find_search_cost(model, tables.range_step, exp(model.costs.log_step_discount), std::span(detected).first(ranges), search_cost);
  find_samples(search_cost, std::span(detected).first(ranges), std::span(foreseen_).first(ranges));
  return ranges;
}

/// Of a measurement there, by what was expected of the action whose end is next to it.
float OceanBelief::expected_detection(const BeliefModel& model, NorthEast position) const {
  float expected = 0.0F;
  Meters nearest{kAnyRange_m};
  for (std::size_t a = 0; heard_ > 0 && a < model.actions.size(); ++a) {
    const Meters range = range_between(listened_at_ + model.step_length * model.actions[a], position);
    if (range < nearest) expected = action_values_[a].detected;
    nearest = std::min(nearest, range);
  }
  return expected;
}

void OceanBelief::add_joint(const BeliefModel& model, std::size_t index, std::span<float> joint) const {
  CellPlaces places;
  std::array<std::uint16_t, CellPlaces::kMostAxes> axes;
  places.find(model, hypothesis(index).drift, heard_, {});
  places.find_axes(model, axes);
  retained_[index / kLanes].add_to(model, index % kLanes, share(index), axes, all_cells(model), joint);
}

std::uint32_t OceanBelief::fingerprint(const BeliefModel& model) const {
  static_assert(std::endian::native == std::endian::little);
  const auto bytes_of = [](const auto* first, std::size_t count) {
    return std::span(reinterpret_cast<const std::uint8_t*>(first), count * sizeof(*first));
  };
  std::uint32_t crc = crc32(bytes_of(marginal_.data(), cell_count(model)));
  for (const HypothesisBlock& block : retained_) crc = block.fingerprint(model, crc);
  return crc32(bytes_of(action_values_.data(), model.actions.size()), crc);
}

}  // namespace earshot::policy
