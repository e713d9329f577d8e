#pragma once

#include <cstddef>
#include <vector>

#include "sim/listening/plan.hpp"
#include "sim/spectrum/band_levels.hpp"

namespace earshot::listening {

/// Third-octave levels as they are given: Chain::unit(), NaN for silence, which has no level.
struct Levels {
  bool is_dated = false;        ///< every file tells when it began
  std::vector<double> begin_s;  ///< of the intervals; from 1970 in UTC where dated, else from the start of the sequence
  std::vector<spectrum::ThirdOctave> bands;
  std::vector<float> level_db;             ///< [n_interval x n_band], of the mean power
  std::vector<float> level_percentile_db;  ///< [n_interval x n_percentile x n_band], of windows of a second
};

/// @param first  number of the interval to begin with
[[nodiscard]] Levels levels_of(const spectrum::BandLevels& levels, const Plan& plan, std::size_t first = 0);

}  // namespace earshot::listening
