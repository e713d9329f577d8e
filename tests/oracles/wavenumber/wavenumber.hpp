#pragma once

#include <complex>
#include <span>
#include <vector>

namespace earshot::oracle {

/// A homogeneous layer of fluid.
struct Layer {
  double thickness_m;  ///< > 0; of no meaning for the last one, which is a half-space
  double sound_speed_mps;
  double density;  ///< of water's
  double attenuation_db_per_wavelength = 0.0;
};

/// A horizontally layered ocean under a pressure-release surface.
struct LayeredOcean {
  std::vector<Layer> layers;  ///< from the surface down, the last a half-space
  double frequency_hz;
  double source_depth_m;
  double receiver_depth_m;
};

/// Slices of equal thickness over which the sound speed goes linearly from `top_mps` to `base_mps`, each with that of its middle.
[[nodiscard]] std::vector<Layer> gradient(double thickness_m, double top_mps, double base_mps, int slices);

/// Complex pressure of a point source of unit amplitude at 1 m, by wavenumber integration.
///
///   p(r) = int_0^inf g(k) J0(k r) k dk,   (1 / rho) g' jumps by -2 / rho_s at the source
///
/// g comes from admittances handed on from layer to layer, up from the half-space and down from the surface. The path of integration runs
/// below the real axis, where no mode lies; Gauss's rule of eight points to each turn of J0. Exact but for rounding and the rule: no
/// parabola, no grid, no absorber.
///
/// @param range_m  each > 0; the cost is the greatest of them times their number
/// Source: Jensen, Kuperman, Porter & Schmidt, Computational Ocean Acoustics, 2nd ed., 2.4.1 (integral), 4.5 (path).
[[nodiscard]] std::vector<std::complex<double>> pressure(const LayeredOcean& ocean, std::span<const double> range_m);

}  // namespace earshot::oracle
