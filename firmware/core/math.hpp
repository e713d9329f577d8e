#pragma once

#include <bit>
#include <cstdint>

#include "firmware/core/units.hpp"

namespace earshot {

// Elementary functions whose bits do not depend on the machine or its libm: plain IEEE add, multiply, divide in a fixed order
// (the firmware is built with -ffp-contract=off). A NaN stays a NaN.

/// Neither NaN nor infinite; looks at the bits, so that no compiler flag can optimise it away.
[[nodiscard]] constexpr bool is_finite(double x) {
  return (std::bit_cast<std::uint64_t>(x) & 0x7FF0000000000000U) != 0x7FF0000000000000U;
}
[[nodiscard]] constexpr bool is_finite(float x) {
  return (std::bit_cast<std::uint32_t>(x) & 0x7F800000U) != 0x7F800000U;
}

// Bounds of a number, as one instruction where std::min is four: a Cortex-M that has doubles has an instruction for it (FPv5). Of two zeros
// either may come out.
#if defined(__ARM_ARCH_PROFILE) && __ARM_ARCH_PROFILE == 'M' && (__ARM_FP & 8)
[[nodiscard]] inline float lesser(float a, float b) {
  return __builtin_fminf(a, b);
}
[[nodiscard]] inline float greater(float a, float b) {
  return __builtin_fmaxf(a, b);
}
#else
/// The lesser of two numbers; b where a is a NaN.
[[nodiscard]] inline float lesser(float a, float b) {
  return a < b ? a : b;
}
/// The greater of two numbers; b where a is a NaN.
[[nodiscard]] inline float greater(float a, float b) {
  return a > b ? a : b;
}
#endif

/// e^x; 0 and +infinity beyond float's range.
/// Error: at most 0.501 ulp (the double it is rounded from is good to 1e-15).   Oracle: Exp.IsWithinHalfAnUlpOfLongDouble
[[nodiscard]] float exp(float x);

/// e^x; 0 below -700 and +infinity above 700.
/// Error: at most 1e-15 of the result.   Oracle: ExpOfDouble.IsWithinTenToTheMinusFifteenOfLongDouble
[[nodiscard]] double exp(double x);

/// Natural logarithm; -infinity of zero, NaN of a negative number.
/// Error: at most 1e-15 of the result, or 1e-16 where it is smaller than a tenth.   Oracle: Log.IsWithinTenToTheMinusFifteenOfLongDouble
[[nodiscard]] double log(double x);

/// Square root by IEEE 754's correctly rounded operation (an instruction on every target, not libm).
[[nodiscard]] double sqrt(double x);

struct SineCosine {
  double sine;
  double cosine;
};
/// Sine and cosine of an angle of any finite size; NaN otherwise.
/// Error: at most 4e-16, and beyond +-pi another 4e-17 of the angle (whole turns are taken off as multiples of the double next to 2 pi).
/// Oracle: SineCosine.IsWithinFourTimesTenToTheMinusSixteenOfLongDouble
[[nodiscard]] SineCosine sine_cosine(Radians angle);

/// Angle of the vector (north, east), clockwise from north, in (-pi, pi]; zero for the zero vector. NaN where either is, and where both are
/// infinite. Error: at most 1e-15 rad.   Oracle: BearingOf.IsWithinTenToTheMinusFifteenOfLongDouble
[[nodiscard]] Radians bearing_of(double north, double east);

/// The same angle in (-pi, pi]; an angle that lies there already comes back bit for bit. NaN unless finite.
[[nodiscard]] Radians wrap_to_pi(Radians angle);

}  // namespace earshot
