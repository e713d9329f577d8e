#include "policy/explain/integrated_gradients.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "policy/explain/network_gradient.hpp"

namespace earshot::explain {
namespace {

std::vector<double> parts_with(const policy::FrozenPolicy& policy, const Comparison& c, std::size_t action, std::size_t steps) {
  const std::size_t size = c.observation.size();
  std::vector<double> mean_gradient(size, 0.0);
  std::vector<double> between(size);
  for (std::size_t k = 0; k < steps; ++k) {
    const double t = (static_cast<double>(k) + 0.5) / static_cast<double>(steps);
    for (std::size_t i = 0; i < size; ++i) between[i] = c.baseline[i] + t * (c.observation[i] - c.baseline[i]);
    const LogProbability there = log_probability(policy, between, action);
    for (std::size_t i = 0; i < size; ++i) mean_gradient[i] += there.gradient[i] / static_cast<double>(steps);
  }
  for (std::size_t i = 0; i < size; ++i) mean_gradient[i] *= c.observation[i] - c.baseline[i];
  return mean_gradient;
}

bool agree(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  return std::ranges::equal(a, b, [tolerance](double x, double y) { return std::abs(x - y) <= tolerance; });
}

}  // namespace

double Attribution::sum() const {
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

bool Attribution::is_complete() const {
  return is_settled && std::abs(sum() - difference()) <= tolerance;
}

Attribution integrated_gradients(const policy::FrozenPolicy& policy, const Comparison& comparison, std::size_t action, double tolerance) {
  assert(comparison.observation.size() == policy.observation.spec.size() && comparison.baseline.size() == policy.observation.spec.size());
  Attribution result;
  result.at_observation = log_probability(policy, comparison.observation, action).value;
  result.at_baseline = log_probability(policy, comparison.baseline, action).value;
  result.tolerance = tolerance;
  for (result.steps = kFewestSteps;; result.steps *= 2) {
    const std::vector<double> before = std::exchange(result.parts, parts_with(policy, comparison, action, result.steps));
    result.is_settled = agree(before, result.parts, tolerance);
    if (result.is_complete() || result.steps >= kMostSteps) return result;
  }
}

}  // namespace earshot::explain
