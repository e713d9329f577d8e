#include "sim/ocean/file/acoustics_toolbox/interpolated.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace earshot::ocean::acoustics_toolbox {
namespace {

constexpr double kTolerance_mps = 1e-3;

/// Parts of an interval in which a curve of at most this second derivative is as good as its chords.
std::size_t parts(double largest_second_derivative, double interval_m) {
  constexpr double kMost = 1000.0;
  const double sagitta_mps = std::abs(largest_second_derivative) * interval_m * interval_m / 8.0;
  return static_cast<std::size_t>(std::clamp(std::ceil(std::sqrt(sagitta_mps / kTolerance_mps)), 1.0, kMost));
}

TabulatedProfile squared_index(const TabulatedProfile& given) {
  TabulatedProfile fine{.depth_m = {given.depth_m.front()}, .sound_speed_mps = {given.sound_speed_mps.front()}};
  for (std::size_t i = 1; i < given.depth_m.size(); ++i) {
    const double above = given.sound_speed_mps[i - 1];
    const double below = given.sound_speed_mps[i];
    const double interval_m = given.depth_m[i] - given.depth_m[i - 1];
    const double slope = 1.0 / (below * below) - 1.0 / (above * above);  // of 1/c^2, over the interval
    // c = s^(-1/2) has the second derivative 3/4 c^5 (ds/dz)^2.
    const double bend = 0.75 * std::pow(std::max(above, below), 5.0) * slope * slope / (interval_m * interval_m);
    const std::size_t count = parts(bend, interval_m);
    for (std::size_t part = 1; part < count; ++part) {
      const double fraction = static_cast<double>(part) / static_cast<double>(count);
      fine.depth_m.push_back(given.depth_m[i - 1] + fraction * interval_m);
      fine.sound_speed_mps.push_back(1.0 / std::sqrt(1.0 / (above * above) + fraction * slope));
    }
    fine.depth_m.push_back(given.depth_m[i]);
    fine.sound_speed_mps.push_back(below);
  }
  return fine;
}

/// Second derivatives of the spline at its depths, three at least.
///
///   h_i-1 m_i-1 + 2 (h_i-1 + h_i) m_i + h_i m_i+1 = 6 (d_i - d_i-1),   d: slopes of the chords
///
/// At either end the third derivative is the same in the two outermost intervals, so that the outermost m follows from its neighbours.
std::vector<double> second_derivatives(const TabulatedProfile& given) {
  const std::size_t n = given.depth_m.size();
  std::vector<double> step(n - 1);
  std::vector<double> slope(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    step[i] = given.depth_m[i + 1] - given.depth_m[i];
    slope[i] = (given.sound_speed_mps[i + 1] - given.sound_speed_mps[i]) / step[i];
  }
  if (n == 3) return std::vector<double>(3, 2.0 * (slope[1] - slope[0]) / (step[0] + step[1]));

  std::vector<double> lower(n, 0.0);
  std::vector<double> diagonal(n, 0.0);
  std::vector<double> upper(n, 0.0);
  std::vector<double> right(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    lower[i] = step[i - 1];
    diagonal[i] = 2.0 * (step[i - 1] + step[i]);
    upper[i] = step[i];
    right[i] = 6.0 * (slope[i] - slope[i - 1]);
  }
  // m_0 = m_1 - (m_2 - m_1) h_0 / h_1, and likewise at the other end, put into the equations of the second and the last but one depth.
  const double first = step[0] / step[1];
  diagonal[1] += step[0] * (1.0 + first);
  upper[1] -= step[0] * first;
  const double last = step[n - 2] / step[n - 3];
  diagonal[n - 2] += step[n - 2] * (1.0 + last);
  lower[n - 2] -= step[n - 2] * last;

  std::vector<double> m(n, 0.0);
  for (std::size_t i = 2; i + 1 < n; ++i) {
    const double factor = lower[i] / diagonal[i - 1];
    diagonal[i] -= factor * upper[i - 1];
    right[i] -= factor * right[i - 1];
  }
  m[n - 2] = right[n - 2] / diagonal[n - 2];
  for (std::size_t i = n - 3; i >= 1; --i) m[i] = (right[i] - upper[i] * m[i + 1]) / diagonal[i];
  m[0] = (1.0 + first) * m[1] - first * m[2];
  m[n - 1] = (1.0 + last) * m[n - 2] - last * m[n - 3];
  return m;
}

TabulatedProfile spline(const TabulatedProfile& given) {
  const std::vector<double> m = second_derivatives(given);
  TabulatedProfile fine{.depth_m = {given.depth_m.front()}, .sound_speed_mps = {given.sound_speed_mps.front()}};
  for (std::size_t i = 1; i < given.depth_m.size(); ++i) {
    const double interval_m = given.depth_m[i] - given.depth_m[i - 1];
    const std::size_t count = parts(std::max(std::abs(m[i - 1]), std::abs(m[i])), interval_m);
    for (std::size_t part = 1; part < count; ++part) {
      const double b = static_cast<double>(part) / static_cast<double>(count);
      const double a = 1.0 - b;
      const double bend = ((a * a * a - a) * m[i - 1] + (b * b * b - b) * m[i]) * interval_m * interval_m / 6.0;
      fine.depth_m.push_back(given.depth_m[i - 1] + b * interval_m);
      fine.sound_speed_mps.push_back(a * given.sound_speed_mps[i - 1] + b * given.sound_speed_mps[i] + bend);
    }
    fine.depth_m.push_back(given.depth_m[i]);
    fine.sound_speed_mps.push_back(given.sound_speed_mps[i]);
  }
  return fine;
}

}  // namespace

TabulatedProfile interpolated(const TabulatedProfile& profile, Interpolation interpolation) {
  if (interpolation == Interpolation::kSquaredIndex) return squared_index(profile);
  if (interpolation == Interpolation::kSpline && profile.depth_m.size() > 2) return spline(profile);
  return profile;
}

}  // namespace earshot::ocean::acoustics_toolbox
