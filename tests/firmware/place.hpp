#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"

namespace earshot {

/// The place so many metres north and east of the origin.
constexpr NorthEast at(double north_m, double east_m) {
  return {Meters{north_m}, Meters{east_m}};
}

}  // namespace earshot
