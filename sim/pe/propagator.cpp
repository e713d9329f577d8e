#include "sim/pe/propagator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace earshot::pe {

namespace {

using Complex = std::complex<double>;

constexpr double kVerticalWeight = 0.05;
constexpr double kEvanescentWeight = 0.002;
constexpr double kBeyond = 1e-3;  // the fit reaches this far above the most grazing wave
constexpr int kAngles = 60;
constexpr int kEvanescent = 20;
// No wave is slower than the slowest medium; a few points there, for what they cost little, keep poles away from the real axis.
constexpr int kSlower = 12;
constexpr double kSlowerPhase = 16.0;  // k0 dr x, as far as the step turns a few times
constexpr double kSlowerWeight = 1e-3;

struct Point {
  double x;
  double weight;
};

double weight_at(double angle, double trapped_angle) {
  return std::pow(kVerticalWeight, std::max(0.0, (angle - trapped_angle) / (0.5 * std::numbers::pi - trapped_angle)));
}

std::vector<Point> points_of(const Spectrum& spectrum, double phase) {
  const double scale = 1.0 + spectrum.highest;  // 1 + x = scale cos^2(angle)
  const double trapped_angle = std::acos(std::sqrt((1.0 + spectrum.trapped) / scale));
  std::vector<Point> points{{spectrum.highest + kBeyond, 1.0}, {spectrum.highest + 0.5 * kBeyond, 1.0}};
  for (int i = 0; i < kAngles; ++i) {
    const double angle = 0.5 * std::numbers::pi * (i + 0.5) / kAngles;
    points.push_back({scale * std::cos(angle) * std::cos(angle) - 1.0, weight_at(angle, trapped_angle)});
  }
  const double nearest = 1e-3;
  for (int i = 0; i < kEvanescent; ++i) {
    const double beyond = nearest * std::pow(-(spectrum.lowest + 1.0) / nearest, static_cast<double>(i) / (kEvanescent - 1));
    points.push_back({-1.0 - beyond, kEvanescentWeight});
  }
  for (int i = 1; i <= kSlower; ++i) {
    const double share = static_cast<double>(i) / kSlower;
    points.push_back({spectrum.highest + 2.0 * kBeyond + std::min(30.0, kSlowerPhase / phase) * share * share, kSlowerWeight});
  }
  return points;
}

Complex vertical_root(double x) {
  return std::sqrt(Complex(1.0 + x, 0.0));
}
Complex advance(double phase, double x) {
  return std::exp(Complex(0.0, phase) * (vertical_root(x) - 1.0));
}

std::vector<Complex> values(const std::vector<Point>& points, double phase, bool as_pressure) {
  std::vector<Complex> result;
  for (const Point& point : points) {
    const Complex value = advance(phase, point.x);
    result.push_back(as_pressure ? value / std::sqrt(vertical_root(point.x)) : value);
  }
  return result;
}

void measure(Propagator& propagator, double phase, const Spectrum& spectrum) {
  constexpr int kChecks = 2000;
  propagator.largest_error = propagator.largest_modulus = 0.0;
  for (int i = 0; i <= kChecks; ++i) {
    const double x = spectrum.highest - (spectrum.highest + 2.0) * i / kChecks;
    const Complex fitted = propagator.step(x);
    propagator.largest_modulus = std::max(propagator.largest_modulus, std::abs(fitted));
    if (x >= spectrum.trapped) propagator.largest_error = std::max(propagator.largest_error, std::abs(fitted - advance(phase, x)));
  }
}

}  // namespace

Propagator make_propagator(double reference_wavenumber_per_m, double step_m, std::span<const double> offset_m, const Spectrum& spectrum,
                           std::size_t terms) {
  const double phase = reference_wavenumber_per_m * step_m;
  const std::vector<Point> points = points_of(spectrum, phase);
  Samples samples;
  for (const Point& point : points) samples.x.push_back(point.x), samples.weight.push_back(point.weight);
  samples.value = values(points, phase, false);

  Propagator propagator;
  propagator.step.pole = fit_poles(samples, terms);
  for (Complex& pole : propagator.step.pole) pole = {pole.real(), -std::abs(pole.imag())};
  const ResidueFit fit(samples.x, samples.weight, propagator.step.pole);
  propagator.step.residue = fit.residues(samples.value);
  for (const double offset : offset_m)
    propagator.pressure_residue.push_back(fit.residues(values(points, reference_wavenumber_per_m * offset, true)));
  measure(propagator, phase, spectrum);
  return propagator;
}

}  // namespace earshot::pe
