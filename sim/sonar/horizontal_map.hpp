#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/sonar/detection.hpp"
#include "sim/sonar/fan.hpp"

namespace earshot::sonar {

/// What is heard at one depth on a square grid around a source, in the local north-east plane.
struct HorizontalMap {
  std::vector<double> north_m;
  std::vector<double> east_m;
  std::vector<float> snr_db;                 ///< [n_north x n_east]; NaN on land, below the sea floor and beyond the fan
  std::vector<float> detection_probability;  ///< [n_north x n_east]
};

struct MapGrid {
  Meters side;            ///< of the square, centred on the source, > 0
  std::size_t intervals;  ///< along a side, >= 1
};

/// The largest square that lies within a fan.
[[nodiscard]] inline Meters largest_side(const Fan& fan) {
  return std::numbers::sqrt2 * fan.max_range();
}

/// @param depth  index into the fan's depths
/// Interpolated as Fan::transmission_loss_at does. Oracle: HorizontalMap.*
[[nodiscard]] HorizontalMap make_map(const Fan& fan, std::size_t depth, const MapGrid& grid, const Detector& detector,
                                     const pe::Progress& progress = {});

}  // namespace earshot::sonar
