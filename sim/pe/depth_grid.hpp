#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

#include "sim/ocean/environment.hpp"

namespace earshot::pe {

/// How the depth axis is cut. The sea floor and every sediment interface lie on a node.
struct DepthGridOptions {
  Meters step;                        ///< largest element outside the absorber, > 0
  double absorber_wavelengths = 6.0;  ///< thickness of the perfectly matched layer in the half-space, in its wavelengths, > 0
};

/// One element between two nodes: a uniform stretch of one medium, its length complex inside the perfectly matched layer.
struct Element {
  std::complex<double> length_m;
  double density_g_per_cm3;
  std::complex<double> squared_wavenumber_top;     ///< k^2 at its upper node, 1/m^2
  std::complex<double> squared_wavenumber_bottom;  ///< k^2 at its lower node
  std::size_t medium;                              ///< 0 for water, then the sediment layers
};

/// The depth axis from the sea surface to the end of the absorber: node 0 is the surface, node i + 1 ends element i.
///
/// Attenuation enters as k = (omega / c) (1 + i alpha / (40 pi log10 e)), alpha in dB per wavelength.
/// Source: Jensen, Kuperman, Porter & Schmidt, Computational Ocean Acoustics, 2nd ed., Eq. 1.47 and 6.141.
struct DepthGrid {
  std::vector<Element> elements;
  double water_step_m;  ///< length of the elements in the water
  std::size_t sea_floor_node;
};

[[nodiscard]] DepthGrid make_depth_grid(const ocean::SoundSpeedProfile& water, const ocean::Seabed& seabed, Hertz frequency,
                                        const DepthGridOptions& options);

/// A depth between nodes as a weighted sum of up to four nodes: cubic Lagrange interpolation that does not reach across the sea floor.
/// The pressure is taken to be odd about the sea surface. The same weights divided by the step make a point source at that depth.
struct DepthTap {
  std::size_t first_node;
  std::array<double, 4> weight;
};

/// @param depth  above the sea floor or on it, >= 0
/// Oracle: DepthTap.IsExactForACubicBelowTheSurface
[[nodiscard]] DepthTap tap_at(const DepthGrid& grid, Meters depth);

}  // namespace earshot::pe
