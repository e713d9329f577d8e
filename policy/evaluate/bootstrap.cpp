#include "policy/evaluate/bootstrap.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "firmware/core/random.hpp"

namespace earshot::evaluate {
namespace {

constexpr std::size_t kResamples = 1'000;

/// One statistic of every resample.
struct Statistics {
  std::vector<double> mean;
  std::vector<double> median;
  std::vector<double> found;
  std::vector<double> path;
};

/// The median: the same as quantile(values, 0.5), which sorts all of them.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return values.size() % 2 == 1 ? *middle : 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

void add_resample(std::span<const Flight> flights, Pcg32& random, std::vector<double>& rewards, Statistics& all) {
  const auto count = static_cast<double>(flights.size());
  double sum = 0.0;
  double found = 0.0;
  double path_m = 0.0;
  double straight_m = 0.0;
  for (double& reward : rewards) {
    const Flight& flight = flights[static_cast<std::size_t>(random.uniform_double() * count)];
    reward = flight.record.reward;
    sum += reward;
    if (flight.record.end != search::EpisodeEnd::kFound) continue;
    found += 1.0;
    path_m += flight.path_m;
    straight_m += flight.straight_m;
  }
  all.mean.push_back(sum / count);
  all.median.push_back(median(rewards));
  all.found.push_back(found / count);
  if (straight_m > 0.0) all.path.push_back(path_m / straight_m);
}

Interval middle_95_percent(const std::vector<double>& values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (values.size() < kResamples / 2) return {kNone, kNone};
  return {quantile(values, 0.025), quantile(values, 0.975)};
}

}  // namespace

Intervals bootstrap(std::span<const Flight> flights, std::uint64_t seed) {
  assert(!flights.empty());
  Pcg32 random(seed);
  Statistics all;
  std::vector<double> rewards(flights.size());
  for (std::size_t i = 0; i < kResamples; ++i) add_resample(flights, random, rewards, all);
  return {.mean_reward = middle_95_percent(all.mean),
          .median_reward = middle_95_percent(all.median),
          .found_fraction = middle_95_percent(all.found),
          .path_over_straight = middle_95_percent(all.path)};
}

}  // namespace earshot::evaluate
