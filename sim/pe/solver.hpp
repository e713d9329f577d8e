#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"

namespace earshot::pe {

/// What is left empty is chosen from the wavelength: a sixteenth of the shortest in depth, a quarter in range.
struct Options {
  std::optional<Meters> depth_step;
  std::optional<Meters> range_step;
  std::size_t terms = 8;              ///< poles of the propagator, 1 to 12; a multiple of 8 fills the vector lanes
  double absorber_wavelengths = 6.0;  ///< thickness of the perfectly matched layer
};

/// Complex pressure of a source of unit amplitude at 1 m, without its common phase factor exp(i k0 r).
struct Field {
  Meters range_step;
  std::vector<double> depth_m;
  Eigen::Array<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
      pressure;  ///< [n_range x n_depth], row i at (i + 1) range_step
};

/// Called now and then with the share of the work that is done, 0 to 1.
using Progress = std::function<void(double fraction)>;

/// Sound of `environment.source` against range and depth by the split-step Pade parabolic equation, as far as `max_range` and one row at
/// least.
///
///   p(r + dr, z) = exp(i k0 dr (sqrt(1 + X) - 1)) p(r, z)
///
/// One way, cylindrical spreading, density and attenuation of the sediment included. Nothing is allocated in the march.
///
/// @param receiver_depth_m  each in the water: 0 to the sea floor
/// Throws std::invalid_argument when an argument lies outside its range, std::runtime_error when no rational function serves.
/// Source: Collins, J. Acoust. Soc. Am. 93 (1993) 1736.
/// Oracle: Solver.FollowsTheFullWaveReferenceOfThePapersOcean, Solver.FollowsTheFullWaveReferenceOfThePekerisWaveguide
[[nodiscard]] Field solve(const ocean::Environment& environment, const Options& options, std::span<const double> receiver_depth_m,
                          Meters max_range, const Progress& progress = {});

}  // namespace earshot::pe
