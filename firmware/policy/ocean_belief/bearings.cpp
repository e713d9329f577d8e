#include "firmware/policy/ocean_belief/bearings.hpp"

#include <algorithm>
#include <array>

#include "firmware/core/math.hpp"
#include "firmware/policy/likelihood/bearing_likelihood.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/ocean_belief/hypotheses/cell_places.hpp"
#include "firmware/policy/ocean_belief/hypotheses/each_drift.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

namespace earshot::policy {
namespace {

/// Scales log weights so that the highest is 0 and none below kForgotten. @return what was taken off them
int take_off_highest(std::span<std::int16_t> weights) {
  const int highest = *std::max_element(weights.begin(), weights.end());
  for (std::int16_t& weight : weights) weight = static_cast<std::int16_t>(std::max<int>(weight - highest, kForgotten));
  return highest;
}

BearingLikelihood likelihood_of(const BeliefModel& model, const messages::Bearing& bearing) {
  return {bearing, Meters{std::max(cell_north(model), cell_east(model))}, model.outlier_share};
}

}  // namespace

BearingWeights find_bearing_weights(const BeliefModel& model, const Measurement& measurement, std::span<std::int16_t> by_cell) {
  const BearingLikelihood likelihood = likelihood_of(model, measurement.bearing.bearing());
  for (std::size_t i = 0; i < by_cell.size(); ++i)
    by_cell[i] = static_cast<std::int16_t>(std::max<int>(to_log(likelihood.at(way_to_cell(model, measurement.position, i))), kForgotten));
  const int taken_off = take_off_highest(by_cell);
  return {.by_cell = by_cell, .taken_off = taken_off};
}

void weigh_by_bearing(const BeliefModel& model, const Measurement& measurement, std::uint32_t index, const BearingWeights& weights,
                      HypothesisBlock& block) {
  const BearingLikelihood likelihood = likelihood_of(model, measurement.bearing.bearing());
  const Rectangle area{.south_west = {}, .north_east = model.area_size};
  CellPlaces places;
  std::array<std::uint16_t, config::kMaxBeliefCells> cells;
  // Over `cells`, for the weight of a cell is written when its own has been read: two grids would be the deepest of the vehicle's stack.
  const std::span<std::int16_t> drifted(reinterpret_cast<std::int16_t*>(cells.data()), cell_count(model));
  for_each_drift(block, [&](const Drift& drift, const Lanes& lanes) {
    if (drift.is_none()) return block.weigh_places(model, lanes, weights.by_cell);
    places.find(model, drift, index, {});
    places.find_cells(model, cells);
    for (std::size_t i = 0; i < cell_count(model); ++i) {
      const NorthEast place = places.place(model, i);
      drifted[i] = area.contains(place) ? weights.by_cell[cells[i]]
                                        : static_cast<std::int16_t>(std::clamp<int>(
                                              to_log(likelihood.at(place - measurement.position)) - weights.taken_off, kForgotten, 0));
    }
    block.weigh_places(model, lanes, drifted);
  });
}

void BearingSum::start(const BeliefModel& model) {
  std::fill_n(sum_.log_weights.begin(), cell_count(model), std::int16_t{0});
  sum_.scale = 0;
  is_empty_ = true;
}

void BearingSum::add(const BeliefModel& model, const BearingWeights& weights) {
  const std::span<std::int16_t> sum = std::span(sum_.log_weights).first(cell_count(model));
  std::transform(sum.begin(), sum.end(), weights.by_cell.begin(), sum.begin(),
                 [](std::int16_t before, std::int16_t now) { return static_cast<std::int16_t>(before + now); });
  sum_.scale += take_off_highest(sum);
  is_empty_ = false;
}

}  // namespace earshot::policy
