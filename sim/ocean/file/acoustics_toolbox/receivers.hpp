#pragma once

#include <optional>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/file/list_directed/list_reader.hpp"

namespace earshot::ocean::acoustics_toolbox {

/// Where the source is and where its sound is asked for, as the last part of an .env file says.
struct Receivers {
  std::vector<double> source_depth_m;  ///< in the water, increasing
  std::vector<double> depth_m;         ///< increasing, >= 0
  std::vector<double> range_m;         ///< increasing, >= 0; empty: KRAKEN's file, which states none
  std::optional<Meters> max_range;     ///< of KRAKEN's file, where it is not 0
};

/// Reads source and receivers of BELLHOP, whose file goes on with ranges and the kind of run, or of KRAKEN and SCOOTER, whose file begins
/// with the phase speeds and has no ranges. Throws host::BadInput naming the line.
/// @param sea_floor  at the source
[[nodiscard]] Receivers read_receivers(ListReader& file, Meters sea_floor);

}  // namespace earshot::ocean::acoustics_toolbox
