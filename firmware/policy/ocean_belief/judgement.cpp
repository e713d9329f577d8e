#include "firmware/policy/ocean_belief/judgement.hpp"

#include <algorithm>

#include "firmware/policy/likelihood/belief_grid.hpp"

namespace earshot::policy {
namespace {

/// Standard deviations below what is expected that a source is still taken to be heard as it should be.
constexpr float kFainter = 2.0F;

/// The least SNR that is expected within a step length of the source, by the shares of the hypotheses.
Decibels least_snr_near(const Assumptions& assumed, const RetainedHypotheses& retained) {
  const OceanTables& tables = assumed.tables;
  const auto at = std::min(static_cast<std::size_t>(assumed.model.step_length / tables.range_step), tables.range_count - std::size_t{1});
  float sum_db = 0.0F;
  for (std::size_t i = 0; i < kRetainedHypotheses; ++i) {
    const Hypothesis& h = retained.hypothesis(i);
    sum_db += retained.share(i) * (tables.tables[h.table].snr_db(at) + kLevelOffsets_db[h.level] - kFainter * kSpreads_db[h.spread]);
  }
  return Decibels{double{sum_db}};
}

}  // namespace

void Judgement::start() {
  rule_.start();
  declaration_.reset();
}

void Judgement::judge(const Assumptions& assumed, NorthEast position, const Reception& reception, std::uint32_t index,
                      const RetainedHypotheses& retained, std::span<float> marginal) {
  declaration_.reset();
  const BeliefModel& model = assumed.model;
  const Decibels least_snr = least_snr_near(assumed, retained);
  if (!FoundRule::is_heard_near(reception, least_snr)) return;
  const NorthEast corner = way_of(retained.likeliest_current(), model, index);
  const NorthEast from_corner = position - corner;
  retained.find_marginal(model, corner, index, cells_near(model, from_corner), marginal);
  const float probability = probability_within(model, marginal, from_corner);
  const std::uint32_t near_measurements = rule_.judge({.probability = probability, .reception = reception, .least_snr = least_snr});
  if (near_measurements == 0) return;
  retained.find_marginal(model, corner, index, all_cells(model), marginal);
  const auto likeliest = std::max_element(marginal.begin(), marginal.end());
  const NorthEast way = way_to_cell(model, from_corner, static_cast<std::size_t>(likeliest - marginal.begin()));
  declaration_ = messages::FoundDeclaration{.probability = probability,
                                            .snr = reception.snr,
                                            .least_snr = least_snr,
                                            .likeliest = from_corner + way + corner,
                                            .closest_approach = length_of(way),
                                            .measurement = index,
                                            .near_measurements = near_measurements};
}

}  // namespace earshot::policy
