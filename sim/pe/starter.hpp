#pragma once

#include "sim/pe/rational.hpp"

namespace earshot::pe {

/// Where the eigenvalues of the depth operator X lie on the real axis (attenuation moves them above it).
struct Spectrum {
  double lowest;   ///< most evanescent, < -1
  double highest;  ///< most grazing in the slowest medium, > -1
};

/// Collins' self-starter: what turns a point source's delta function in depth into the field at the range where phase = k0 range.
///
///   S(x) = (1 + x)^(-1/4) exp(i phase (sqrt(1 + x) - 1))
///
/// Fitted over the whole spectrum, the evanescent part included: a propagator that is unitary on the real axis would carry whatever a
/// starter leaves there to all ranges. The error counts fully for steep to grazing waves, less at the branch point and for evanescent
/// waves.
///
/// @param phase  > 0
/// Throws std::runtime_error when no fit reaches `kStarterError`.
/// Source: Collins, "A self-starter for the parabolic equation method", J. Acoust. Soc. Am. 92 (1992) 2069. Deviation: one rational fit
///   (AAA) in place of smoothing by (1 - x)^-2 and a Pade approximant.   Oracle: Starter.FollowsItsFunctionOverTheWholeSpectrum
[[nodiscard]] Rational starter(double phase, const Spectrum& spectrum);

inline constexpr double kStarterError = 1e-5;  ///< so far down that deep interference minima keep their depth

}  // namespace earshot::pe
