#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::report {

/// SNR around a source over a rectangle of equal cells, for a picture.
///
/// A cell shows the mean intensity over all ranges that it covers, not the level at its centre: interference is finer than a cell, and one
/// sample a cell makes rings of dots (moire) that are not in the ocean.
///
///   SNR = 10 log10 (1 / (r2 - r1) integral_r1^r2 10^(SNR(r)/10) dr),   r1, r2 = r -+ half a cell
///
/// @param per_side  cells along a side, at least one
/// @return [per_side x per_side] dB from south to north, each row from west to east
/// Oracle: SnrSurface.*
[[nodiscard]] std::vector<double> snr_surface(const sonar::SnrCurve& curve, NorthEast source, const Rectangle& area, std::size_t per_side);

/// The same as gnuplot reads it: kilometres east, kilometres north, dB.
[[nodiscard]] std::string snr_rows(const sonar::SnrCurve& curve, NorthEast source, const Rectangle& area, std::size_t per_side);

}  // namespace earshot::report
