#include "sim/search/belief_model.hpp"
#include "sim/search/actions/compass_directions.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace earshot::search {
namespace {

constexpr double kCell = 500.0;       // m; a look at a source within l = 1 km of the vehicle ends the search, so finer is not needed
constexpr double kRangeStep = 100.0;  // m

/// As near to 500 m a cell as fits.
void choose_grid(policy::BeliefModel& model) {
  const double north = model.area_size.north.value;
  const double east = model.area_size.east.value;
  const double cell = std::max(kCell, std::sqrt(north * east / static_cast<double>(config::kMaxBeliefCells)));
  const auto count = [cell](double length) { return static_cast<std::uint16_t>(std::max(1.0, std::floor(length / cell + 1e-9))); };
  model.cells_north = std::min(count(north), static_cast<std::uint16_t>(config::kMaxBeliefCells));
  model.cells_east = std::min(count(east), static_cast<std::uint16_t>(config::kMaxBeliefCells / model.cells_north));
}

void sample(const sonar::SnrCurve& curve, policy::BeliefModel& model) {
  const double diagonal = std::hypot(model.area_size.north.value, model.area_size.east.value);
  model.range_step = Meters{std::max(kRangeStep, diagonal / static_cast<double>(config::kMaxBeliefRanges - 2))};
  const auto count = std::min(config::kMaxBeliefRanges, static_cast<std::size_t>(diagonal / model.range_step.value) + 2);
  for (std::size_t i = 0; i < count; ++i) {
    const float snr = static_cast<float>(curve.at(static_cast<double>(i) * model.range_step).value);
    [[maybe_unused]] const Status status = model.snr_db.push_back(snr);
    assert(status == Status::kOk);
  }
}

}  // namespace

policy::BeliefModel belief_model(const SearchSettings& settings, const sonar::SnrCurve& curve) {
  policy::BeliefModel model;
  model.area_size = settings.domain.north_east - settings.domain.south_west;
  model.step_length = settings.step_length;
  model.detection_threshold = settings.detection_threshold;
  model.actions = compass_directions(settings.direction_count);
  model.border_width = settings.border_width;
  model.costs.edge = static_cast<float>(std::max(0.0, -settings.border_reward));
  choose_grid(model);
  for (const policy::BeliefHypothesis hypothesis :
       {policy::BeliefHypothesis{0.0F, 1.0F, 2.0F}, policy::BeliefHypothesis{0.0F, 4.0F, 2.0F}, policy::BeliefHypothesis{-6.0F, 4.0F, 1.0F},
        policy::BeliefHypothesis{6.0F, 4.0F, 1.0F}}) {
    [[maybe_unused]] const Status status = model.hypotheses.push_back(hypothesis);
    assert(status == Status::kOk);
  }
  sample(curve, model);
  return model;
}

}  // namespace earshot::search
