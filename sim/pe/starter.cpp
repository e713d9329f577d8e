#include "sim/pe/starter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "sim/pe/aaa.hpp"

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;

constexpr double kGap = 1e-3;  ///< nothing is sampled nearer than this to the branch point, where S has no bound

Complex value(double x, double phase) {
  const Complex root = std::sqrt(Complex(1.0 + x, 0.0));
  return std::exp(Complex(0.0, phase) * (root - 1.0)) / std::sqrt(root);
}

double weight(double x) {
  return std::min(1.0, x > -1.0 ? 2.0 * (1.0 + x) : std::sqrt(-1.0 - x));
}

/// `offset` from 0 to 1 shifts the points, so that a fit can be checked between the points it was made from.
Samples sample(double phase, const Spectrum& spectrum, double offset) {
  constexpr int kPoints = 300;
  Samples samples;
  const auto add = [&](double x) {
    samples.x.push_back(x);
    samples.value.push_back(value(x, phase));
    samples.weight.push_back(weight(x));
  };
  for (int i = 0; i < kPoints; ++i) {
    const double t = (i + offset) / kPoints;
    add(-1.0 + kGap + (spectrum.highest + 1.0 - kGap) * t * t);
    add(-1.0 - kGap * std::pow((-1.0 - spectrum.lowest) / kGap, t));
  }
  return samples;
}

/// The field has eigenvalues on the real axis up to `highest` and anywhere above it.
bool has_pole_in_the_spectrum(const Rational& rational, const Spectrum& spectrum) {
  return std::any_of(rational.pole.begin(), rational.pole.end(), [&](Complex coefficient) {
    const Complex pole = -1.0 / coefficient;
    return !(pole.imag() < 0.0) && pole.real() < spectrum.highest + 0.5;
  });
}

}  // namespace

Rational starter(double phase, const Spectrum& spectrum) {
  constexpr std::size_t kFewest = 8;
  constexpr std::size_t kMost = 32;
  const Samples samples = sample(phase, spectrum, 1.0);
  const Samples between = sample(phase, spectrum, 0.5);
  for (std::size_t terms = kFewest; terms <= kMost; terms += 2) {
    Rational fit = fit_rational(samples, terms);
    if (!has_pole_in_the_spectrum(fit, spectrum) && weighted_error(fit, between) <= kStarterError) return fit;
  }
  throw std::runtime_error("no starting field for a phase of " + std::to_string(phase) + " rad and X from " +
                           std::to_string(spectrum.lowest) + " to " + std::to_string(spectrum.highest));
}

}  // namespace earshot::pe
