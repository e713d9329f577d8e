#pragma once

#include <algorithm>

#include "firmware/core/units.hpp"

namespace earshot::vehicle {

/// Its charge, and what a way through the water takes of it.
struct Battery {
  double percent = 100.0;
  double percent_per_km = 0.6;

  void sail(Meters way) { percent = std::max(percent - way.value * 1e-3 * percent_per_km, 0.0); }
};

}  // namespace earshot::vehicle
