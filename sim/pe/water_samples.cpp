#include "sim/pe/water_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

namespace earshot::pe {

namespace {

/// Integrals of 1 / c^2 over an element, with the shares of its upper and its lower node.
struct Moments {
  double upper = 0.0;
  double lower = 0.0;
};

/// Gauss's rule of three points over each stretch of the element in which the table is linear.
Moments moments_of(const ocean::TabulatedProfile& table, double top_m, double bottom_m) {
  constexpr std::array<std::pair<double, double>, 3> kGauss{
      {{-0.7745966692414834, 5.0 / 18.0}, {0.0, 8.0 / 18.0}, {0.7745966692414834, 5.0 / 18.0}}};
  Moments sum;
  auto next = std::upper_bound(table.depth_m.begin(), table.depth_m.end(), top_m);
  for (double from = top_m; from < bottom_m;) {
    const double to = next == table.depth_m.end() ? bottom_m : std::min(bottom_m, *next++);
    for (const auto& [x, weight] : kGauss) {
      const double depth_m = 0.5 * (from + to) + 0.5 * (to - from) * x;
      const double speed_mps = ocean::sound_speed(table, Meters{depth_m}).value;
      const double share = weight * (to - from) / (speed_mps * speed_mps);
      const double t = (depth_m - top_m) / (bottom_m - top_m);
      sum.upper += share * (1.0 - t);
      sum.lower += share * t;
    }
    from = to;
  }
  return sum;
}

std::vector<double> samples_of(const ocean::TabulatedProfile& table, double step_m, std::size_t intervals) {
  std::vector<double> mean(intervals + 3);  // of 1 / c^2, from the node above the surface to the one below the last
  for (std::size_t i = 0; i + 1 < mean.size(); ++i) {
    const double top_m = (static_cast<double>(i) - 1.0) * step_m;
    const Moments moments = moments_of(table, top_m, top_m + step_m);
    mean[i] += moments.upper / step_m;
    mean[i + 1] += moments.lower / step_m;
  }
  mean.front() *= 2.0;
  mean.back() *= 2.0;
  std::vector<double> speed_mps;
  for (std::size_t i = 1; i + 1 < mean.size(); ++i)
    speed_mps.push_back(1.0 / std::sqrt(mean[i] - (mean[i + 1] - 2.0 * mean[i] + mean[i - 1]) / 12.0));
  return speed_mps;
}

}  // namespace

std::vector<double> water_samples(const ocean::SoundSpeedProfile& profile, Meters step, std::size_t intervals) {
  if (const auto* table = std::get_if<ocean::TabulatedProfile>(&profile)) return samples_of(*table, step.value, intervals);
  std::vector<double> speed_mps;
  for (std::size_t node = 0; node <= intervals; ++node)
    speed_mps.push_back(ocean::sound_speed(profile, static_cast<double>(node) * step).value);
  return speed_mps;
}

}  // namespace earshot::pe
