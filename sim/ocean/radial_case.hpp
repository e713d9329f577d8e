#pragma once

#include <optional>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"

namespace earshot::ocean {

/// One ocean and where on a radial its sound is asked for, as the input file of another propagation model states both.
///
/// Such a file names no levels: the source's and the noise's are 0 dB, so that SNR is minus the loss.
struct RadialCase {
  Environment environment;                    ///< its source at the first of the depths
  std::vector<double> source_depth_m = {};    ///< in the water, increasing; empty: the environment's alone
  std::vector<double> receiver_depth_m = {};  ///< increasing, >= 0; some may lie below the sea floor; empty: not stated
  std::vector<double> receiver_range_m = {};  ///< increasing, >= 0, the last > 0; empty: not stated
  std::optional<Meters> max_range = {};       ///< > 0; where a file states no ranges but how far it goes

  /// How far the file goes, by its ranges or without them; nothing where it states neither.
  [[nodiscard]] std::optional<Meters> furthest() const {
    return receiver_range_m.empty() ? max_range : std::optional(Meters{receiver_range_m.back()});
  }
};

}  // namespace earshot::ocean
