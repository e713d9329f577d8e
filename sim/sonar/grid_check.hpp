#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "sim/ocean/section.hpp"
#include "sim/pe/options.hpp"
#include "sim/sonar/radial.hpp"

namespace earshot::sonar {

/// How much transmission loss changes when the solver's depth step and range step are halved and its absorber is three times as thick.
struct GridCheck {
  Meters depth_step;  ///< of the coarse grid
  Meters range_step;
  double mean_db;  ///< of |change|, over all ranges and depths in the water beyond one wavelength
  double max_db;
  Meters range_of_max;  ///< usually an interference minimum
  Meters depth_of_max;
};

/// Runs the radial twice, at the highest frequency of the plan's band, which is the one that asks most of a grid.
/// @param section,name  as of compute_radial
/// Throws as that does. Oracle: GridCheck.*
[[nodiscard]] GridCheck check_grid(const ocean::Section& section, const std::string& name, const RadialPlan& plan,
                                   const pe::Progress& progress = {});

}  // namespace earshot::sonar
