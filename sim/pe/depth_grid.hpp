#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware/core/units.hpp"
#include "sim/ocean/section.hpp"
#include "sim/pe/absorber.hpp"

namespace earshot::pe {

/// The depth axis: nodes 0 (the surface) to `intervals` (the end of the absorber), equally spaced down to the absorber. Interfaces need not
/// lie on nodes.
struct DepthGrid {
  double step_m;
  std::size_t intervals;
  double reference_wavenumber_per_m;  ///< k0, of the slowest medium
  double deepest_medium_m;            ///< no sea floor and no layer of the section lies below; a few steps further on the absorber begins
  Absorber absorber;                  ///< the last elements

  [[nodiscard]] std::size_t absorber_node() const { return intervals - absorber.elements; }
};

[[nodiscard]] DepthGrid make_depth_grid(const ocean::Section& section, Hertz frequency, Meters step, const Absorber& absorber);

/// Lowest and highest sound speed of a section, water and sediment.
struct SoundSpeedBounds {
  double lowest_mps;
  double highest_mps;
};
[[nodiscard]] SoundSpeedBounds sound_speed_bounds(const ocean::Section& section);

/// Where density jumps: the slope of pressure against depth jumps with it, dp/dz / density does not.
struct Interface {
  double depth_m;
  double density_above;
  double density_below;
};

/// A depth between nodes as a weighted sum of nodes: Lagrange interpolation over six nodes of one medium (fewer where there is no room for
/// six), odd about the surface. Between a medium's last node and its interface, the sixth is the interface, whose pressure is such that
/// dp/dz / density of the polynomials on its two sides is one. By reciprocity the same weights make a source: starter.hpp.
struct DepthTap {
  static constexpr std::size_t kNodes = 10;
  std::array<std::size_t, kNodes> node{};
  std::array<double, kNodes> weight{};
  std::size_t count = 0;  ///< of those used

  void add(long signed_node, double weight_there);
};

/// @param depth_m    from 0 to the deepest medium
/// @param interface  from the sea floor down; a depth on one belongs to the medium above
/// Oracle: DepthTap.*, WavenumberIntegration.*
[[nodiscard]] DepthTap tap_at(const DepthGrid& grid, double depth_m, std::span<const Interface> interface);

}  // namespace earshot::pe
