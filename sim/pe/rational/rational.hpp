#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/pe/rational/small_matrix.hpp"

namespace earshot::pe {

/// A rational function that vanishes at infinity, as a sum of simple poles: every pole is one tridiagonal solve and all of them share one
/// right-hand side.
///
///   R(x) = sum_j residue_j / (1 - x / pole_j)
struct Rational {
  std::vector<std::complex<double>> pole;
  std::vector<std::complex<double>> residue;

  [[nodiscard]] std::complex<double> operator()(std::complex<double> x) const;
};

/// A function known at real points, with the weight its error has at each.
struct Samples {
  std::vector<double> x;
  std::vector<std::complex<double>> value;
  std::vector<double> weight;
};

/// Poles that serve a function: support points chosen greedily where the weighted error is largest, barycentric weights from the least
/// singular vector of the weighted Loewner matrix.
///
/// @param terms  number of poles, at most a third of the number of samples
/// Throws std::runtime_error when a pole is not finite.
/// Source: Nakatsukasa, Sete & Trefethen, "The AAA algorithm for rational approximation", SIAM J. Sci. Comput. 40 (2018) A1494.
///   Deviations: the weights; the value at infinity is held at zero.   Oracle: Rational.RecoversAFunctionWithThreePolesFromItsSamples
[[nodiscard]] std::vector<std::complex<double>> fit_poles(const Samples& samples, std::size_t terms);

/// Least squares for residues over given poles; factorised once, it serves any number of functions on the same points.
/// Oracle: Rational.RecoversAFunctionWithThreePolesFromItsSamples
class ResidueFit {
 public:
  ResidueFit(std::span<const double> x, std::span<const double> weight, std::span<const std::complex<double>> pole);

  [[nodiscard]] std::vector<std::complex<double>> residues(std::span<const std::complex<double>> value) const;

 private:
  std::vector<double> weight_;
  PivotedQr factors_;
};

}  // namespace earshot::pe
