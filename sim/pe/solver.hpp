#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/section.hpp"
#include "sim/pe/options.hpp"

namespace earshot::pe {

/// What a march was made on.
struct MarchGrid {
  Meters depth_step;
  Meters range_step;
  std::size_t terms;
  double predicted_error_db;          ///< mean |dTL| that choose_grid expects of its choice; NaN where the caller chose otherwise
  double reference_wavenumber_per_m;  ///< k0
};

/// Complex pressure of a source of unit amplitude at 1 m, without its common phase factor exp(i k0 r).
struct Field {
  Meters range_step;  ///< between rows
  std::vector<double> depth_m;
  /// [n_range x n_depth], row i at (i + 1) range_step.
  Eigen::Array<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> pressure;
  MarchGrid grid;
};

struct PointSource {
  Hertz frequency;
  Meters depth;
};

/// Sound of a point source against range and depth by the parabolic equation, as far as `max_range` and one row at least.
///
///   u(r + dr) = exp(i k0 dr (sqrt(1 + X) - 1)) u(r),   u = (1 + X)^(1/4) p,   u(0) from starter.hpp
///
/// One way, cylindrical spreading; density, attenuation and layers of the sediment, bathymetry and water against range. The march allocates
/// nothing. X is that of the middle of a step; where it changes, pressure and velocity are matched in the mean (sweep.hpp).
///
/// @param receiver_depth_m  each from 0 to 12000 m, below the sea floor too; no deeper than the half-space
/// Throws std::invalid_argument that names what lies outside its range, and for terms or a range step of the caller's over which sound
/// would be off by more than 3 dB at `max_range`, or grow; and where the grid that is chosen here would be off by more than kWorstError
/// in the mean, and is much more than what was asked for: doubt_of().
/// Source: Collins, J. Acoust. Soc. Am. 93 (1993) 1736; energy-conserving form: Collins & Westwood, J. Acoust. Soc. Am. 89 (1991) 1068.
/// Oracle: Solver.*
[[nodiscard]] Field solve(const ocean::Section& section, const PointSource& source, const Options& options,
                          std::span<const double> receiver_depth_m, Meters max_range, const Progress& progress = {});

}  // namespace earshot::pe
