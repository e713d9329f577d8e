#include "sim/pe/depth_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <variant>

namespace earshot::pe {

namespace {

void widen(SoundSpeedBounds& bounds, double sound_speed_mps) {
  bounds.lowest_mps = std::min(bounds.lowest_mps, sound_speed_mps);
  bounds.highest_mps = std::max(bounds.highest_mps, sound_speed_mps);
}

}  // namespace

SoundSpeedBounds sound_speed_bounds(const Section& section) {
  SoundSpeedBounds bounds{1e9, 0.0};
  double deepest = 0.0;
  for (const FloorPoint& point : section.floor) deepest = std::max(deepest, point.depth_m);
  for (const WaterColumn& column : section.water) {
    constexpr int kSamples = 200;
    for (int i = 0; i <= kSamples; ++i) widen(bounds, ocean::sound_speed(column.profile, Meters{deepest * i / kSamples}).value);
    if (const auto* table = std::get_if<ocean::TabulatedProfile>(&column.profile)) {
      for (std::size_t i = 0; i < table->depth_m.size(); ++i)
        if (table->depth_m[i] <= deepest) widen(bounds, table->sound_speed_mps[i]);
    }
  }
  for (const SedimentColumn& column : section.sediment)
    for (const SedimentPoint& point : column.points) widen(bounds, point.sound_speed_mps);
  return bounds;
}

DepthGrid make_depth_grid(const Section& section, Hertz frequency, Meters step, double absorber_wavelengths) {
  double floor = 0.0;
  for (const FloorPoint& point : section.floor) floor = std::max(floor, point.depth_m);
  double layers = 0.0;
  double fastest = 0.0;
  for (const SedimentColumn& column : section.sediment) {
    layers = std::max(layers, column.points.back().depth_below_floor_m);
    fastest = std::max(fastest, column.points.back().sound_speed_mps);
  }
  const double end = floor + layers + absorber_wavelengths * fastest / frequency.value;
  return {.step_m = step.value,
          .intervals = static_cast<std::size_t>(std::ceil(end / step.value)),
          .reference_wavenumber_per_m = 2.0 * std::numbers::pi * frequency.value / sound_speed_bounds(section).lowest_mps,
          .absorber_top_m = floor + layers};
}

DepthTap tap_at(const DepthGrid& grid, double depth_m, double floor_depth_m) {
  const auto last_node = static_cast<long>(grid.intervals);
  const double position = depth_m / grid.step_m;
  const bool in_water = depth_m <= floor_depth_m;
  const double floor_position = floor_depth_m / grid.step_m;
  // The element with the interface in it belongs to both sides: the nodes just beyond are used only for a depth inside it.
  const long lowest = in_water ? -last_node : static_cast<long>(std::min(std::ceil(floor_position), std::floor(position)));
  const long highest = in_water ? static_cast<long>(std::max(std::floor(floor_position), std::ceil(position))) : last_node;
  constexpr long kNodes = static_cast<long>(DepthTap::kNodes);
  const long count = std::min(kNodes, highest - lowest + 1);
  long first = static_cast<long>(std::floor(position)) - count / 2 + 1;
  first = std::clamp(first, lowest, highest - count + 1);

  DepthTap tap;
  for (long i = first; i < first + count; ++i) {
    double weight = 1.0;
    for (long m = first; m < first + count; ++m)
      if (m != i) weight *= (position - static_cast<double>(m)) / static_cast<double>(i - m);
    const auto slot = static_cast<std::size_t>(i - first);
    tap.node[slot] = static_cast<std::size_t>(std::labs(i));
    tap.weight[slot] = i < 0 ? -weight : weight;
  }
  return tap;
}

}  // namespace earshot::pe
