// What bearings say to an OceanBelief: of the places of a source that rests all at once, of one that drifts measurement by measurement.

#include <algorithm>
#include <span>

#include "firmware/core/math.hpp"
#include "firmware/policy/likelihood/bearing_likelihood.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/ocean_belief/hypotheses/cell_places.hpp"
#include "firmware/policy/ocean_belief/hypotheses/each_drift.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"
#include "firmware/policy/ocean_belief/ocean_belief.hpp"

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

OceanBelief::PastBearing OceanBelief::to_remember(const std::optional<messages::Bearing>& bearing) {
  if (!bearing) return {};
  const Radians axis = bearing->mirror_axis.value_or(bearing->direction);  // it mirrors into itself where nothing is mirrored
  return {.direction = static_cast<float>(bearing->direction.value),
          .deviation = static_cast<float>(bearing->deviation.value),
          .mirror_axis = static_cast<float>(axis.value)};
}

messages::Bearing OceanBelief::PastBearing::bearing() const {
  return {.direction = Radians{double{direction}}, .deviation = Radians{double{deviation}}, .mirror_axis = Radians{double{mirror_axis}}};
}

/// What the bearing of a measurement says of every cell, to by_cell_. @return the highest, which is taken off
int OceanBelief::find_bearing_likelihood(const BeliefModel& model, const Measurement& measurement) {
  const BearingLikelihood likelihood = likelihood_of(model, measurement.bearing.bearing());
  for (std::size_t i = 0; i < cell_count(model); ++i)
    by_cell_[i] = static_cast<std::int16_t>(std::max<int>(to_log(likelihood.at(way_to_cell(model, measurement.position, i))), kForgotten));
  return take_off_highest(std::span(by_cell_).first(cell_count(model)));
}

/// The others that are being weighed hear it now, whatever they have heard of the past, where they rest: the order is the same to them.
void OceanBelief::take_in_bearing(const BeliefModel& model, const Measurement& measurement) {
  const int taken_off = find_bearing_likelihood(model, measurement);
  const std::span<std::int16_t> by_bearing = std::span(by_cell_).first(cell_count(model));
  const std::span<std::int16_t> sum = std::span(bearings_.log_weights).first(cell_count(model));
  model_mismatch_.take_in_bearing(taken_off);
  std::transform(sum.begin(), sum.end(), by_bearing.begin(), sum.begin(),
                 [](std::int16_t before, std::int16_t now) { return static_cast<std::int16_t>(before + now); });
  bearings_.scale += take_off_highest(sum);
  has_bearings_ = true;
  for (HypothesisBlock& block : retained_) weigh_bearing(model, measurement, taken_off, heard_, block);
  if (has_candidates_ && candidates_.hypothesis(0).drift.is_none()) weigh_bearing(model, measurement, taken_off, heard_, candidates_);
}

/// Those that drift and are being weighed hear it with its measurement.
void OceanBelief::take_in_past_bearing(const BeliefModel& model, const Measurement& measurement, std::uint32_t index) {
  const int taken_off = find_bearing_likelihood(model, measurement);
  weigh_bearing(model, measurement, taken_off, index, candidates_);
}

/// A cell that has drifted takes what the bearing says (by_cell_) of the cell that it is in; beyond the area what it says of its place.
/// @param taken_off  of by_cell_   @param index  of the measurement
void OceanBelief::weigh_bearing(const BeliefModel& model, const Measurement& measurement, int taken_off, std::uint32_t index,
                                HypothesisBlock& block) {
  const BearingLikelihood likelihood = likelihood_of(model, measurement.bearing.bearing());
  const Rectangle area{.south_west = {}, .north_east = model.area_size};
  CellPlaces places;
  std::array<std::uint16_t, config::kMaxBeliefCells> cells;
  // Over `cells`, for what is said of a cell is written when its own has been read: two grids would be the deepest of the vehicle's stack.
  const std::span<std::int16_t> drifted(reinterpret_cast<std::int16_t*>(cells.data()), cell_count(model));
  for_each_drift(block, [&](const Drift& drift, const Lanes& lanes) {
    if (drift.is_none()) return block.weigh_places(model, lanes, by_cell_);
    places.find(model, drift, index, {});
    places.find_cells(model, cells);
    for (std::size_t i = 0; i < cell_count(model); ++i) {
      const NorthEast place = places.place(model, i);
      drifted[i] =
          area.contains(place)
              ? by_cell_[cells[i]]
              : static_cast<std::int16_t>(std::clamp<int>(to_log(likelihood.at(place - measurement.position)) - taken_off, kForgotten, 0));
    }
    block.weigh_places(model, lanes, drifted);
  });
}

}  // namespace earshot::policy
