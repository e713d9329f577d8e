#include "sim/pe/depth_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace earshot::pe {
namespace {

std::complex<double> squared_wavenumber(Hertz frequency, MetersPerSecond sound_speed, double attenuation_db_per_wavelength) {
  const double decibels_to_loss = 1.0 / (40.0 * std::numbers::pi * std::numbers::log10e);
  const std::complex<double> k = 2.0 * std::numbers::pi * frequency.value / sound_speed.value *
                                 std::complex<double>(1.0, decibels_to_loss * attenuation_db_per_wavelength);
  return k * k;
}

std::size_t elements_of(double thickness_m, Meters step) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(thickness_m / step.value - 1e-9)));
}

void append_water(DepthGrid& grid, const ocean::SoundSpeedProfile& water, Meters depth, Hertz frequency, Meters step) {
  constexpr std::size_t kFewest = 4;  // what a DepthTap reaches over
  grid.sea_floor_node = std::max(kFewest, elements_of(depth.value, step));
  grid.water_step_m = depth.value / static_cast<double>(grid.sea_floor_node);
  const auto at_node = [&](std::size_t i) {
    return squared_wavenumber(frequency, sound_speed(water, Meters{grid.water_step_m * static_cast<double>(i)}), 0.0);
  };
  for (std::size_t i = 0; i < grid.sea_floor_node; ++i) grid.elements.push_back({grid.water_step_m, 1.0, at_node(i), at_node(i + 1), 0});
}

void append_layer(DepthGrid& grid, const ocean::SedimentLayer& layer, std::size_t medium, Hertz frequency, Meters step) {
  const std::size_t count = elements_of(layer.thickness.value, step);
  const std::complex<double> k2 = squared_wavenumber(frequency, layer.sound_speed, layer.attenuation_db_per_wavelength);
  const double length = layer.thickness.value / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) grid.elements.push_back({length, layer.density_g_per_cm3, k2, k2, medium});
}

/// Perfectly matched layer: depth continued into the complex plane, dz~ = (1 + i stretch s^2) dz for s from 0 to 1 through the layer, so
/// that what propagates downward decays without being reflected.
void append_absorber(DepthGrid& grid, const ocean::SedimentLayer& layer, std::size_t medium, Hertz frequency,
                     const DepthGridOptions& options) {
  constexpr std::complex<double> kStretch(0.0, 4.0);
  const double thickness = options.absorber_wavelengths * layer.sound_speed.value / frequency.value;
  const std::size_t count = elements_of(thickness, options.step);
  const std::complex<double> k2 = squared_wavenumber(frequency, layer.sound_speed, layer.attenuation_db_per_wavelength);
  const double length = thickness / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double s = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    grid.elements.push_back({length * (1.0 + kStretch * (s * s)), layer.density_g_per_cm3, k2, k2, medium});
  }
}

}  // namespace

DepthGrid make_depth_grid(const ocean::SoundSpeedProfile& water, const ocean::Seabed& seabed, Hertz frequency,
                          const DepthGridOptions& options) {
  DepthGrid grid{};
  append_water(grid, water, seabed.depth, frequency, options.step);
  const std::size_t half_space = seabed.layers.size() - 1;
  for (std::size_t i = 0; i < half_space; ++i) append_layer(grid, seabed.layers[i], i + 1, frequency, options.step);
  append_absorber(grid, seabed.layers[half_space], half_space + 1, frequency, options);
  return grid;
}

DepthTap tap_at(const DepthGrid& grid, Meters depth) {
  const double position = depth.value / grid.water_step_m;
  // Nodes -1 to 2 around the first element: node -1 mirrors node 1 with the opposite sign and is folded into it below.
  const double last_first = static_cast<double>(grid.sea_floor_node) - 3.0;
  const double first = std::max(-1.0, std::min(std::floor(position) - 1.0, last_first));
  std::array<double, 4> weight{};
  for (std::size_t i = 0; i < 4; ++i) {
    weight[i] = 1.0;
    for (std::size_t j = 0; j < 4; ++j) {
      if (j != i) weight[i] *= (position - first - static_cast<double>(j)) / (static_cast<double>(i) - static_cast<double>(j));
    }
  }
  if (first >= 0.0) return {static_cast<std::size_t>(first), weight};
  return {0, {0.0, weight[2] - weight[0], weight[3], 0.0}};
}

}  // namespace earshot::pe
