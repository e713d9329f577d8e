#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "firmware/core/units.hpp"
#include "sim/ocean/section.hpp"

namespace earshot::pe {

/// The grid of a march, and the error it is expected to make.
struct GridChoice {
  Meters depth_step;
  Meters range_step;
  std::size_t terms;
  double predicted_error_db;  ///< mean |dTL| against the limit of a fine grid
};

/// The coarsest grid that keeps a mean error of transmission loss, from the errors measured on some thirty oceans (measurements.md):
///
///   depth step   0.028 dB (15 h / lambda)^4 max(1, H / 40 lambda)^0.75 + 0.85 dB r (k_v^2 / k_h) (k_v h)^4 / 480
///                  lambda the shortest wavelength; k_v, k_h of the steepest wave that the sea floor keeps in
///   thin water   3.2 dB (h / D)^4                 D the water's depth at the source, or that of the shallowest tenth of the range
///   slope        0.07 dB sqrt(r / lambda) tan^1.5 (2 dr / lambda)^2   tan the root-mean-square slope of the sea floor
///   corners      0.2 dB integral of tan^2 / depth dr   no grid lessens it: the evanescent waves of ever shorter steps
///   propagator   8.7 dB N e(k0 dr),  e = 4e-7 (k0 dr / 16)^4 for 16 terms
///
/// Where D is less than half a wavelength, so that no wave is kept in the water, no range step is longer than one.
///
/// @param accuracy   of the mean over ranges, dB, > 0
/// @param max_range  > 0
/// Oracle: GridChoice.*, AutomaticGrid.*
[[nodiscard]] GridChoice choose_grid(const ocean::Section& section, Hertz frequency, Meters max_range, Decibels accuracy);

/// Beyond it a field is no prediction: over a sea floor that goes up and down within a step, sound may even grow.
inline constexpr Decibels kWorstError{10.0};

/// What must be known of a field whose error is predicted to be ten times what was asked, and 1 dB more than it; else nothing.
/// @param predicted_error_db  NaN where the caller chose the grid: then nothing is known
[[nodiscard]] std::optional<std::string> doubt_of(double predicted_error_db, Decibels accuracy);

}  // namespace earshot::pe
