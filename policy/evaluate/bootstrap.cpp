#include "policy/evaluate/bootstrap.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "firmware/core/random.hpp"
#include "policy/evaluate/time_to_find.hpp"
#include "sim/search/streams.hpp"

namespace earshot::evaluate {
namespace {

constexpr std::size_t kResamples = 1'000;
constexpr std::uint64_t kResampling = search::kStreams - 1;  // the stream; searches have those from 0 on

/// One statistic of every resample.
struct Statistics {
  std::vector<double> mean;
  std::vector<double> median;
  std::vector<double> steps;
  std::vector<double> path;
};

/// The median: the same as quantile(values, 0.5), which sorts all of them.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return values.size() % 2 == 1 ? *middle : 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

void add_resample(std::span<const Flight> flights, std::uint32_t max_steps, Pcg32& random, std::vector<double>& rewards, Statistics& all) {
  const auto count = static_cast<double>(flights.size());
  double sum = 0.0;
  double steps = 0.0;
  double path_m = 0.0;
  double straight_m = 0.0;
  for (double& reward : rewards) {
    const Flight& flight = flights[static_cast<std::size_t>(random.uniform_double() * count)];
    reward = flight.record.reward;
    sum += reward;
    steps += restricted_steps(flight.record, max_steps);
    if (flight.record.end != search::EpisodeEnd::kFound) continue;
    path_m += flight.path_m;
    straight_m += flight.straight_m;
  }
  all.mean.push_back(sum / count);
  all.median.push_back(median(rewards));
  all.steps.push_back(steps / count);
  if (straight_m > 0.0) all.path.push_back(path_m / straight_m);
}

Interval middle_95_percent(const std::vector<double>& values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (values.size() < kResamples / 2) return {kNone, kNone};
  return {quantile(values, 0.025), quantile(values, 0.975)};
}

}  // namespace

Intervals bootstrap(std::span<const Flight> flights, std::uint32_t max_steps, std::uint64_t seed, const std::function<void()>& between) {
  assert(!flights.empty());
  Pcg32 random = search::evaluation_random(seed, kResampling);
  Statistics all;
  std::vector<double> rewards(flights.size());
  for (std::size_t i = 0; i < kResamples; ++i) {
    if (between) between();
    add_resample(flights, max_steps, random, rewards, all);
  }
  return {.restricted_mean_steps = middle_95_percent(all.steps),
          .mean_reward = middle_95_percent(all.mean),
          .median_reward = middle_95_percent(all.median),
          .path_over_straight = middle_95_percent(all.path)};
}

}  // namespace earshot::evaluate
