#include "firmware/policy/likelihood/belief_grid.hpp"

#include <algorithm>

#include "firmware/core/wide.hpp"

namespace earshot::policy {
namespace {

/// Share of its probability that a cell within step_length of a place visited keeps.
constexpr float kCovered = 1e-3F;

}  // namespace

CellWindow::Side cells_along(float place, float radius, float size, std::size_t count) {
  const auto index = [count](float cell) -> std::size_t {
    if (!(cell > 0.0F)) return 0;
    return cell < static_cast<float>(count) ? static_cast<std::size_t>(cell) : count;  // infinite for a fix beyond any area
  };
  return {.first = static_cast<std::uint16_t>(index((place - radius) / size - 0.5F)),
          .end = static_cast<std::uint16_t>(index((place + radius) / size + 0.5F))};
}

double cell_north(const BeliefModel& model) {
  return model.area_size.north.value / static_cast<double>(model.cells_north);
}

double cell_east(const BeliefModel& model) {
  return model.area_size.east.value / static_cast<double>(model.cells_east);
}

NorthEast way_to_cell(const BeliefModel& model, NorthEast position, std::size_t cell) {
  const auto centre = [](std::size_t index, double size) { return Meters{(static_cast<double>(index) + 0.5) * size}; };
  return {.north = centre(cell / model.cells_east, cell_north(model)) - position.north,
          .east = centre(cell % model.cells_east, cell_east(model)) - position.east};
}

std::size_t half_cell(const BeliefModel& model, Meters range_step, std::size_t ranges) {
  const double cell = std::max(cell_north(model), cell_east(model));
  return std::min(static_cast<std::size_t>(0.5 * cell / range_step.value), ranges - 1);
}

std::size_t ranges_to_all(const BeliefModel& model, NorthEast position, Meters beyond, Meters range_step, std::size_t ranges) {
  const NorthEast furthest{std::max(position.north, model.area_size.north - position.north),
                           std::max(position.east, model.area_size.east - position.east)};
  const double steps = (length_of(furthest) + beyond) / range_step + 2.0;  // one rounded up, and the one at no range
  return steps < static_cast<double>(ranges) ? static_cast<std::size_t>(steps) : ranges;
}

EARSHOT_WIDE void smooth(std::span<const float> values, std::size_t half, std::span<float> smoothed) {
  const std::size_t count = values.size();
  const float share = 1.0F / static_cast<float>(2 * half + 1);
  const auto held = [&](std::size_t i) {  // at the ends
    float sum = 0.0F;
    for (std::size_t k = 0; k <= 2 * half; ++k) sum += values[std::clamp(i + k, half, count - 1 + half) - half];
    return sum * share;
  };
  const std::size_t last = count > 2 * half ? count - half : half;
  for (std::size_t i = 0; i < std::min(half, count); ++i) smoothed[i] = held(i);
  // Sample by sample of the mean, so that a vector unit can take many means at once.
  for (std::size_t i = half; i < last; ++i) smoothed[i] = values[i - half];
  for (std::size_t k = 1; k <= 2 * half; ++k) {
    for (std::size_t i = half; i < last; ++i) smoothed[i] += values[i - half + k];
  }
  for (std::size_t i = half; i < last; ++i) smoothed[i] *= share;
  for (std::size_t i = last; i < count; ++i) smoothed[i] = held(i);
}

EARSHOT_WIDE void find_uncovered(const BeliefModel& model, Meters range_step, std::span<float> shares) {
  const auto cell = static_cast<float>(std::max(cell_north(model), cell_east(model)));
  const auto apart = static_cast<float>(range_step.value);
  const auto reach = static_cast<float>(model.step_length.value);
  for (std::size_t i = 0; i < shares.size(); ++i)
    shares[i] = std::clamp((static_cast<float>(i) * apart - reach) / cell + 0.5F, kCovered, 1.0F);
}

}  // namespace earshot::policy
