#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"

namespace earshot {

/// A place, by its metres.
constexpr NorthEast at(double north_m, double east_m) {
  return {Meters{north_m}, Meters{east_m}};
}

}  // namespace earshot
