#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "firmware/policy/frozen_policy.hpp"

namespace earshot::explain {

/// Two observations of the same policy: the one that was acted upon, and the one it is compared with.
struct Comparison {
  std::span<const double> observation;
  std::span<const double> baseline;
};

/// How much each element of an observation moved the log-probability of an action away from what it would be at the baseline.
struct Attribution {
  std::vector<double> parts;    ///< [observation_size], in nats: a part of log 2 doubles the action's probability
  double at_observation = 0.0;  ///< log-probability of the action
  double at_baseline = 0.0;
  std::size_t steps = 0;    ///< of the integral, as many as it took
  double tolerance = 0.0;   ///< that the completeness was held against
  bool is_settled = false;  ///< whether the last doubling of the steps moved no part by more than the tolerance

  [[nodiscard]] double sum() const;
  [[nodiscard]] double difference() const { return at_observation - at_baseline; }
  /// Completeness: the parts are settled and add up to the difference within the tolerance. (The errors of two parts may cancel.)
  [[nodiscard]] bool is_complete() const;
};

inline constexpr double kCompleteness = 1e-3;  ///< nats: a tenth of a percent of a probability
inline constexpr std::size_t kFewestSteps = 32;
inline constexpr std::size_t kMostSteps = 4'096;

/// Integrated gradients along the straight line from the baseline to the observation.
///
///   part_i = (x_i - x'_i) * integral_0^1 dF/dx_i (x' + t (x - x')) dt,   sum of the parts = F(x) - F(x')
///
/// F is the log-probability of the action. The integral is a midpoint sum whose steps are doubled until the parts are settled and
/// complete within `tolerance`, or kMostSteps are used: Attribution::is_complete says which.
///
/// @param action  below the number of actions
/// Source: Sundararajan, Taly, Yan, "Axiomatic attribution for deep networks", ICML 2017, Eq. 1 and Proposition 1.
/// Oracle: IntegratedGradients.AreThoseOfAHandComputedNetwork, IntegratedGradients.AddUpToTheDifference...
[[nodiscard]] Attribution integrated_gradients(const policy::FrozenPolicy& policy, const Comparison& comparison, std::size_t action,
                                               double tolerance = kCompleteness);

}  // namespace earshot::explain
