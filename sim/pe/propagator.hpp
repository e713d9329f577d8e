#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/pe/rational/rational.hpp"

namespace earshot::pe {

/// Where the eigenvalues of the depth operator X lie on the real axis; attenuation and the absorber lift them above it.
struct Spectrum {
  double lowest;   ///< most evanescent, < -1
  double trapped;  ///< waves above this do not leave through the sea floor, in (-1, highest)
  double highest;  ///< most grazing in the slowest medium, > -1
};

/// The range step and what is read off within it, as rational functions of X over the same poles.
///
///   step(x)    = exp(i k0 dr (sqrt(1 + x) - 1))
///   pressure_m = exp(i k0 s_m (sqrt(1 + x) - 1)) (1 + x)^(-1/4),   0 < s_m <= dr
///
/// The march carries u = (1 + X)^(1/4) p, in which a point source is a delta function and the energy flux is the plain square: the
/// starter and the conservation of energy on a slope cost nothing, and the pressure at any number of ranges inside the step comes from the
/// same solutions.
struct Propagator {
  Rational step;
  std::vector<std::vector<std::complex<double>>> pressure_residue;  ///< [n_offset][n_pole], over step.pole
  double largest_error;                                             ///< |step - R| over waves that stay in the water
  double largest_modulus;                                           ///< |R| over the real axis: what a wave can grow by in one step
};

/// Fits a propagator over the whole spectrum, evanescent waves included: errors count fully for waves that the sea floor keeps in, down to
/// 1/20 for vertical ones, 1/500 for evanescent ones: given more, short steps, of which there are many, lose their accuracy to them. No
/// pole lies above the real axis, where attenuation and absorber put the eigenvalues: one that the fit puts there, beyond the most grazing
/// wave, is reflected.
///
/// @param reference_wavenumber_per_m  k0 > 0
/// @param step_m                      dr > 0
/// @param offset_m                    s_m, each in (0, dr]
/// @param terms                       poles, 2 to 16
/// Source: Collins, J. Acoust. Soc. Am. 93 (1993) 1736 (split-step Pade). Deviation: fitted (AAA and least squares) in place of a Taylor
///   series at x = 0: the same error at two to four times the step.   Oracle: Propagator.*
[[nodiscard]] Propagator make_propagator(double reference_wavenumber_per_m, double step_m, std::span<const double> offset_m,
                                         const Spectrum& spectrum, std::size_t terms);

}  // namespace earshot::pe
