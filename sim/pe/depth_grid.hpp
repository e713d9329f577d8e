#pragma once

#include <array>
#include <cstddef>

#include "firmware/core/units.hpp"
#include "sim/pe/section.hpp"

namespace earshot::pe {

/// The depth axis: nodes 0 (the surface) to `intervals` (the end of the absorber), equally spaced. Interfaces need not lie on nodes.
struct DepthGrid {
  double step_m;
  std::size_t intervals;
  double reference_wavenumber_per_m;  ///< k0, of the slowest medium
  double absorber_top_m;              ///< below every sea floor and every layer of the section
};

/// @param absorber_wavelengths  thickness of the absorber in wavelengths of the fastest half-space, > 0
[[nodiscard]] DepthGrid make_depth_grid(const Section& section, Hertz frequency, Meters step, double absorber_wavelengths);

/// Lowest and highest sound speed of a section, water and sediment.
struct SoundSpeedBounds {
  double lowest_mps;
  double highest_mps;
};
[[nodiscard]] SoundSpeedBounds sound_speed_bounds(const Section& section);

/// A depth between nodes as a weighted sum of nodes: Lagrange interpolation over six nodes on one side of the sea floor (fewer where there
/// is no room for six), odd about the surface. The same weights divided by the step make a point source at that depth.
struct DepthTap {
  static constexpr std::size_t kNodes = 6;
  std::array<std::size_t, kNodes> node{};  ///< 0 with weight 0 where unused
  std::array<double, kNodes> weight{};
};

/// @param depth_m        from 0 to the depth of the last node
/// @param floor_depth_m  of the sea floor there
/// Oracle: DepthTap.*
[[nodiscard]] DepthTap tap_at(const DepthGrid& grid, double depth_m, double floor_depth_m);

}  // namespace earshot::pe
