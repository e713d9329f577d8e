#pragma once

#include <optional>

#include "sim/ocean/charts/bathymetry.hpp"
#include "sim/ocean/charts/climatology.hpp"
#include "sim/ocean/charts/geography.hpp"
#include "sim/ocean/water/sea_water.hpp"

namespace earshot::ocean {

/// What is known by geographic position, and where the local plane lies among it.
struct Charts {
  LocalGrid grid;
  std::optional<Bathymetry> bathymetry;
  std::optional<Climatology> climatology;
  SoundSpeedFormula formula = SoundSpeedFormula::kUnesco;  ///< for the climatology
};

}  // namespace earshot::ocean
