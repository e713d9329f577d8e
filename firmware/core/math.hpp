#pragma once

#include "firmware/core/units.hpp"

namespace earshot {

// Elementary functions whose bits do not depend on the machine or its libm: plain IEEE add, multiply, divide in a fixed order
// (the firmware is built with -ffp-contract=off). A NaN stays a NaN.

[[nodiscard]] bool is_finite(double x);
[[nodiscard]] bool is_finite(float x);

/// e^x; 0 and +infinity beyond float's range. Error: see math.cpp.
[[nodiscard]] float exp(float x);

/// Hyperbolic tangent. Error: see math.cpp.
[[nodiscard]] float tanh(float x);

/// Square root by IEEE 754's correctly rounded operation (an instruction on every target, not libm).
[[nodiscard]] double sqrt(double x);

struct SineCosine {
  double sine;
  double cosine;
};
/// Sine and cosine of an angle of any finite size.
[[nodiscard]] SineCosine sine_cosine(Radians angle);

/// Angle of the vector (north, east), clockwise from north, in (-pi, pi]; zero for the zero vector.
[[nodiscard]] Radians bearing_of(double north, double east);

/// The same angle in (-pi, pi].
[[nodiscard]] Radians wrap_to_pi(Radians angle);

}  // namespace earshot
