#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "sim/pe/rational.hpp"

namespace earshot::pe {

/// A function known at real points, with the weight its error has at each.
struct Samples {
  std::vector<double> x;
  std::vector<std::complex<double>> value;
  std::vector<double> weight;
};

/// Fits a rational function with `terms` poles to samples: support points chosen greedily where the weighted error is largest, barycentric
/// weights from the least singular vector of the Loewner matrix, then residues by weighted least squares over all samples.
///
/// @param terms  at most a third of the number of samples
/// Source: Nakatsukasa, Sete & Trefethen, "The AAA algorithm for rational approximation", SIAM J. Sci. Comput. 40 (2018) A1494. Deviations:
/// the
///   weights, and the final least squares in place of the barycentric residues.   Oracle: Aaa.RecoversARationalFunctionFromItsSamples
[[nodiscard]] Rational fit_rational(const Samples& samples, std::size_t terms);

/// Largest weighted error over the samples.
[[nodiscard]] double weighted_error(const Rational& rational, const Samples& samples);

}  // namespace earshot::pe
