#pragma once

#include <numbers>

#include "firmware/core/math.hpp"
#include "firmware/core/units.hpp"

namespace earshot {

/// The same angle as a compass has it, from 0 to 2 pi; 2 pi itself only of an angle that is a rounding below zero. NaN unless finite.
/// Oracle: WrapToTwoPi.*
[[nodiscard]] inline Radians wrap_to_two_pi(Radians angle) {
  const Radians wrapped = wrap_to_pi(angle);
  return wrapped.value < 0.0 ? Radians{wrapped.value + 2.0 * std::numbers::pi} : wrapped;
}

/// Clockwise from north in degrees, [0, 360). Oracle: CompassDegrees.*
[[nodiscard]] inline double compass_degrees(Radians heading) {
  constexpr double kFullTurn_deg = 360.0;
  const double degrees = wrap_to_two_pi(heading).value * 180.0 / std::numbers::pi;
  return degrees >= kFullTurn_deg ? 0.0 : degrees;  // of an angle that is a rounding below zero
}

}  // namespace earshot
