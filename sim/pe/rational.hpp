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

/// The first `count` Taylor coefficients at x = 0 of (1 - x)^2 (1 + x)^(-1/4) exp(i phase (sqrt(1 + x) - 1)), or without the algebraic factors.
/// Oracle: Rational.TaylorSeriesSumsToItsFunction
enum class Function { kPropagator, kStarter };
[[nodiscard]] std::vector<Wide> taylor(Function function, long double phase, std::size_t count);

/// The [n/n] Pade approximant of a function, by its Taylor coefficients (2n + 1 are used).
///
/// @param zeros  each makes the approximant vanish there and gives up one order of accuracy at x = 0
/// Throws std::runtime_error when the poles cannot be found to working accuracy.
/// Source: Collins, "A split-step Pade solution for the parabolic equation method", J. Acoust. Soc. Am. 93 (1993) 1736, Eq. 12-14;
///   the zeros follow the stability constraints of his RAM.   Oracle: Rational.PadeOfTheExponentialIsTheTextbookOne
[[nodiscard]] Rational pade(std::span<const Wide> taylor_coefficients, std::size_t terms, std::span<const double> zeros = {});

/// exp(i phase (sqrt(1 + x) - 1)): one range step of phase = k0 dr.
/// Source: Collins 1993, Eq. 6.   Oracle: Rational.PropagatorFollowsTheSquareRootOverThePropagatingSpectrum
[[nodiscard]] Rational propagator(double phase, std::size_t terms);

/// (1 - x)^2 (1 + x)^(-1/4) exp(i phase (sqrt(1 + x) - 1)): Collins' self-starter after the delta function was smoothed by (1 - x)^-2.
/// Source: Collins, "The stabilized self-starter", J. Acoust. Soc. Am. 106 (1999) 1724.   Oracle: Rational.StarterFollowsItsFunction
[[nodiscard]] Rational starter(double phase, std::size_t terms);

}  // namespace earshot::pe
