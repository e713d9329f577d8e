#include "policy/explain/network_gradient.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace earshot::explain {
namespace {

using Values = std::vector<double>;

/// One dense layer of its own size.
template <class Layer>
struct Dense {
  const Layer& layer;
  std::size_t inputs;
  std::size_t outputs;

  [[nodiscard]] double weight(std::size_t output, std::size_t input) const { return static_cast<double>(layer.weight(output, input)); }

  [[nodiscard]] Values apply(std::span<const double> input) const {
    Values output(outputs);
    for (std::size_t i = 0; i < outputs; ++i) {
      output[i] = static_cast<double>(layer.bias[i]);
      for (std::size_t j = 0; j < inputs; ++j) output[i] += weight(i, j) * input[j];
    }
    return output;
  }

  /// Turns the derivative by the outputs into the derivative by the inputs.
  [[nodiscard]] Values transposed(std::span<const double> by_output) const {
    Values by_input(inputs, 0.0);
    for (std::size_t i = 0; i < outputs; ++i) {
      for (std::size_t j = 0; j < inputs; ++j) by_input[j] += weight(i, j) * by_output[i];
    }
    return by_input;
  }
};

struct Layers {
  Dense<decltype(policy::Network::first)> first;
  Dense<decltype(policy::Network::second)> second;
  Dense<decltype(policy::Network::output)> output;

  explicit Layers(const policy::Network& n)
      : first{n.first, n.observation_size, n.hidden_sizes[0]},
        second{n.second, n.hidden_sizes[0], n.hidden_sizes[1]},
        output{n.output, n.hidden_sizes[1], n.action_count} {}
};

Values apply_tanh(Values values) {
  for (double& x : values) x = std::tanh(x);
  return values;
}

/// derivative by what went into the tanh that gave `activation`
Values before_tanh(Values by_activation, const Values& activation) {
  for (std::size_t i = 0; i < activation.size(); ++i) by_activation[i] *= 1.0 - activation[i] * activation[i];
  return by_activation;
}

double log_sum_exp(const Values& logits) {
  const double top = *std::ranges::max_element(logits);
  double sum = 0.0;
  for (const double z : logits) sum += std::exp(z - top);
  return top + std::log(sum);
}

/// log p_a and its derivative by the logits, [i = a] - p_i.
LogProbability of_logits(const Values& logits, std::size_t action) {
  const double log_sum = log_sum_exp(logits);
  Values by_logit(logits.size());
  for (std::size_t i = 0; i < logits.size(); ++i) by_logit[i] = (i == action ? 1.0 : 0.0) - std::exp(logits[i] - log_sum);
  return {.value = logits[action] - log_sum, .gradient = by_logit};
}

}  // namespace

std::vector<double> logits_of(const policy::Network& network, std::span<const double> observation) {
  assert(observation.size() == network.observation_size);
  const Layers layers(network);
  return layers.output.apply(apply_tanh(layers.second.apply(apply_tanh(layers.first.apply(observation)))));
}

LogProbability log_probability(const policy::Network& network, std::span<const double> observation, std::size_t action) {
  assert(observation.size() == network.observation_size && action < network.action_count);
  const Layers layers(network);
  const Values first = apply_tanh(layers.first.apply(observation));
  const Values second = apply_tanh(layers.second.apply(first));
  const Values logits = layers.output.apply(second);
  const LogProbability by_logit = of_logits(logits, action);
  const Values by_second = before_tanh(layers.output.transposed(by_logit.gradient), second);
  const Values by_first = before_tanh(layers.second.transposed(by_second), first);
  return {.value = by_logit.value, .gradient = layers.first.transposed(by_first)};
}

LogProbability log_probability(const policy::FrozenPolicy& policy, std::span<const double> observation, std::size_t action) {
  if (policy::has_network(policy.network)) return log_probability(policy.network, observation, action);
  const policy::ObservationSpec& spec = policy.observation.spec;
  const auto is_advice = [&spec](std::size_t i) { return spec[i].feature == policy::Feature::kPreference; };
  Values logits(policy.actions.size());
  for (std::size_t i = 0; i < spec.size(); ++i)
    if (is_advice(i)) logits[spec[i].age] = observation[i];
  const LogProbability by_logit = of_logits(logits, action);
  LogProbability result{.value = by_logit.value, .gradient = Values(spec.size(), 0.0)};
  for (std::size_t i = 0; i < spec.size(); ++i)
    if (is_advice(i)) result.gradient[i] = by_logit.gradient[spec[i].age];
  return result;
}

}  // namespace earshot::explain
