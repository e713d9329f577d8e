#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "sim/pe/depth_grid.hpp"

namespace earshot::pe {

/// Rows of a tridiagonal matrix over the nodes below the surface; row i couples node i with i - 1 (lower) and i + 1 (upper).
struct Tridiagonal {
  std::vector<std::complex<double>> lower, diagonal, upper;
};

/// The depth operator of the parabolic equation, discretised as a pencil: X = M^-1 G.
///
///   X = k0^-2 (rho d/dz rho^-1 d/dz + k^2) - 1
///
/// Linear elements for the derivative, continuous pressure and normal velocity at interfaces by construction. The mass weights are
/// Numerov's (1/12, 10/12, 1/12) inside a medium, which makes the scheme fourth order in the step, and (1/6, 4/6, 1/6) on an interface,
/// where Numerov's error terms of the two sides do not cancel. Pressure vanishes at the surface and at the end of the absorber. Oracle:
/// DepthOperator.*
struct DepthOperator {
  Tridiagonal mass;  ///< M
  Tridiagonal g;     ///< G
  [[nodiscard]] std::size_t size() const { return mass.diagonal.size(); }
};

[[nodiscard]] DepthOperator make_depth_operator(const DepthGrid& grid, double reference_wavenumber_per_m);

}  // namespace earshot::pe
