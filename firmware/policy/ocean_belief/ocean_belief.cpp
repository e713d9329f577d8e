#include "firmware/policy/ocean_belief/ocean_belief.hpp"

#include <algorithm>
#include <bit>

#include "firmware/core/crc32.hpp"
#include "firmware/policy/belief/belief_summary.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

namespace earshot::policy {
namespace {

/// No hydrophone measures less: sound of -30 dB adds a thousandth to a power that noise alone makes fluctuate by a tenth (4 Hz, 30 s). Only
/// a simulation can give such a number, and no ocean of any table explains it: the belief would look for the source beyond the area.
constexpr Decibels kLeastMeasurable{-30.0};

/// @param threshold  a detection is a measurement, however faint
Reception measurable(Reception reception, Decibels threshold) {
  const Decibels least = std::min(kLeastMeasurable, threshold);
  if (reception.snr >= least) return reception;
  reception.snr = least;
  reception.too_faint = true;
  return reception;
}

/// log2 of the probability of all measurements, explanations with a prior penalty counting for less.
int log_explained(const Assumptions& assumed, const RetainedHypotheses& retained) {
  std::array<int, kRetainedHypotheses> explanations;
  for (std::size_t i = 0; i < kRetainedHypotheses; ++i) {
    const Hypothesis& h = retained.hypothesis(i);
    explanations[i] = retained.posterior(i) - log_prior_of_ocean(h, assumed.tables) - log_prior(h.drift) - prior_penalty(h);
  }
  return log_of_sum(explanations) - to_log(static_cast<float>(cell_count(assumed.model)));
}

}  // namespace

void OceanBelief::start(const BeliefModel& model, const OceanTables& tables) {
  history_.start();
  bearings_.start(model);
  retained_.start({model, tables}, bearings_.sum());
  replacement_.start();
  judgement_.start();
  assessment_.start();
  model_mismatch_.start();
  silence_.start();
  std::fill_n(marginal_.begin(), cell_count(model), 1.0F / static_cast<float>(cell_count(model)));
  summary_ = {};
  calls_for_sweep_ = false;
}

void OceanBelief::update(const BeliefModel& model, const OceanTables& tables, NorthEast position, Reception reception) {
  while (refine(model, tables)) {
  }
  reception = measurable(reception, model.detection_threshold);
  const Assumptions assumed{model, tables};
  silence_.take_in(model, position, reception, assessment_.expected_detection(model, position));
  const Measurement measurement = measurement_of(position, reception);
  const std::uint32_t index = history_.add(measurement);
  take_in(assumed, measurement, index);
  replacement_.begin(history_);
  model_mismatch_.take_in(reception, log_explained(assumed, retained_));
  judge(assumed, position, reception, index);
  sum_up(assumed, position);
  calls_for_sweep_ = model_mismatch_.calls_for_sweep() || silence_.is_long();
}

bool OceanBelief::refine(const BeliefModel& model, const OceanTables& tables) {
  if (silence_.is_behind()) {
    silence_.catch_up(model, tables);
  } else {
    replacement_.weigh_slice({model, tables}, history_, bearings_, weigher_, retained_);
  }
  return replacement_.is_left();
}

/// The retained hypotheses are weighed by a measurement once the source has moved: bearing and SNR are of where it is now.
void OceanBelief::take_in(const Assumptions& assumed, const Measurement& measurement, std::uint32_t index) {
  for (HypothesisBlock& block : retained_.blocks()) block.let_move(assumed.model);
  if (measurement.bearing.is_there()) take_in_bearing(assumed.model, measurement, index);
  for (HypothesisBlock& block : retained_.blocks()) weigher_.weigh(assumed, measurement, index, block);
  retained_.find_shares(assumed);
}

void OceanBelief::take_in_bearing(const BeliefModel& model, const Measurement& measurement, std::uint32_t index) {
  const BearingWeights weights = weigher_.bearing_weights(model, measurement);
  model_mismatch_.take_in_bearing(weights.taken_off);
  bearings_.add(model, weights);
  for (HypothesisBlock& block : retained_.blocks()) weigh_by_bearing(model, measurement, index, weights, block);
  replacement_.take_in_bearing(model, measurement, index, weights);
}

/// Where the source is declared found, what follows is for a search that goes on nevertheless: the source is elsewhere.
void OceanBelief::judge(const Assumptions& assumed, NorthEast position, const Reception& reception, std::uint32_t index) {
  judgement_.judge(assumed, position, reception, index, retained_, marginal(assumed.model));
  if (!judgement_.declaration()) return;
  history_.mark_declared();  // candidates that have not been weighed by it yet will be
  for (HypothesisBlock& block : retained_.blocks()) weigher_.rule_out(assumed, position, index, block);
  retained_.find_shares(assumed);
}

/// Where the source is by the next measurement, from the corner of the area as the likeliest current has carried it, and what each action
/// promises.
void OceanBelief::sum_up(const Assumptions& assumed, NorthEast position) {
  const BeliefModel& model = assumed.model;
  const std::span<float> probabilities = marginal(model);
  const NorthEast corner = way_of(retained_.likeliest_current(), model, history_.count());
  retained_.find_marginal(model, corner, history_.count(), all_cells(model), probabilities);
  summary_ = summary_of(model, probabilities);
  summary_.mismatch_bits = model_mismatch_.bits();
  summary_.likeliest = summary_.likeliest + corner;
  summary_.mean = summary_.mean + corner;
  assessment_.find(assumed, retained_, history_, position, corner, probabilities);
}

std::uint32_t OceanBelief::fingerprint(const BeliefModel& model) const {
  static_assert(std::endian::native == std::endian::little);
  const auto bytes_of = [](const auto* first, std::size_t count) {
    return std::span(reinterpret_cast<const std::uint8_t*>(first), count * sizeof(*first));
  };
  const std::uint32_t crc = retained_.fingerprint(model, crc32(bytes_of(marginal_.data(), cell_count(model))));
  return crc32(bytes_of(assessment_.values().data(), model.actions.size()), crc);
}

}  // namespace earshot::policy
