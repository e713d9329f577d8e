#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "firmware/policy/frozen_policy.hpp"

namespace earshot::explain {

/// How likely a policy makes an action, and what in the observation would make it likelier.
struct LogProbability {
  double value = 0.0;            ///< natural logarithm of the action's probability, <= 0
  std::vector<double> gradient;  ///< its derivative by each element of the observation, [observation_size]
};

/// Logits of every action in double precision: the frozen network's own weights, none of float's rounding.
[[nodiscard]] std::vector<double> logits_of(const policy::Network& network, std::span<const double> observation);

/// Log-probability of one action under the softmax of the network's logits, and its exact gradient by reverse differentiation.
///
///   log p_a = z_a - log sum_i exp z_i,   d log p_a / d z_i = [i = a] - p_i,   through tanh' = 1 - tanh^2, or ReLU' = 1
///   above zero and else 0, and the transposed weights
///
/// @param observation  [observation_size]
/// @param action       below action_count
/// Oracle: LogProbability.EqualsAHandComputedNetwork, LogProbability.HasTheGradientThatFiniteDifferencesShow
[[nodiscard]] LogProbability log_probability(const policy::Network& network, std::span<const double> observation, std::size_t action);
/// The same of a policy, which need not have a network (policy::find_logits).
[[nodiscard]] LogProbability log_probability(const policy::FrozenPolicy& policy, std::span<const double> observation, std::size_t action);

}  // namespace earshot::explain
