#pragma once

#include <complex>
#include <span>
#include <vector>

namespace earshot::pe {

/// A rational function as a sum of simple poles, so that every pole is one tridiagonal solve and all of them share one right-hand side.
///
///   R(x) = constant + sum_j residue_j / (1 + pole_j x)
struct Rational {
  std::complex<double> constant;
  std::vector<std::complex<double>> pole;
  std::vector<std::complex<double>> residue;

  [[nodiscard]] std::complex<double> operator()(std::complex<double> x) const;
};

using Wide = std::complex<long double>;  ///< Pade systems are ill conditioned: double is used up at about 8 terms

/// The first `count` Taylor coefficients of exp(i phase (sqrt(1 + x) - 1)) at x = 0.
/// Oracle: Rational.TaylorSeriesOfTheStepIsTheHandMadeOne
[[nodiscard]] std::vector<Wide> taylor_of_step(long double phase, std::size_t count);

/// The [n/n] Pade approximant of a function, by its Taylor coefficients (2n + 1 are used).
///
/// Throws std::runtime_error when the poles cannot be found to working accuracy.
/// Source: Collins, "A split-step Pade solution for the parabolic equation method", J. Acoust. Soc. Am. 93 (1993) 1736.
/// Oracle: Rational.PadeOfTheExponentialIsTheTextbookOne
[[nodiscard]] Rational pade(std::span<const Wide> taylor_coefficients, std::size_t terms);

/// exp(i phase (sqrt(1 + x) - 1)): one range step of phase = k0 dr.
///
/// Unlike RAM's it has no stability constraint: the diagonal Pade approximant has modulus one on the whole real axis (its value there is
/// the reciprocal of its conjugate) and its poles lie below, so that it damps whatever attenuation and absorber lift above the axis.
/// Throws std::runtime_error when rounding has left nothing of that.
/// Source: Collins 1993.   Oracle: Rational.StepHasModulusOneOnTheRealAxisAndLessAboveIt
[[nodiscard]] Rational propagator(double phase, std::size_t terms);

}  // namespace earshot::pe
