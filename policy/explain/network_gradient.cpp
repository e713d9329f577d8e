#include "policy/explain/network_gradient.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace earshot::explain {
namespace {

using Values = std::vector<double>;

using Layer = policy::Network::ConstLayer;

Values apply(const Layer& layer, std::span<const double> input) {
  Values output(layer.outputs);
  for (std::size_t i = 0; i < layer.outputs; ++i) {
    output[i] = static_cast<double>(layer.bias[i]);
    for (std::size_t j = 0; j < layer.inputs; ++j) output[i] += static_cast<double>(layer.weight(i, j)) * input[j];
  }
  return output;
}

/// Turns the derivative by the outputs into the derivative by the inputs.
Values transposed(const Layer& layer, std::span<const double> by_output) {
  Values by_input(layer.inputs, 0.0);
  for (std::size_t i = 0; i < layer.outputs; ++i) {
    for (std::size_t j = 0; j < layer.inputs; ++j) by_input[j] += static_cast<double>(layer.weight(i, j)) * by_output[i];
  }
  return by_input;
}

Values activate(policy::Activation activation, Values values) {
  for (double& x : values) {
    if (activation == policy::Activation::kTanh) x = std::tanh(x);
    if (activation == policy::Activation::kRelu && x < 0.0) x = 0.0;
  }
  return values;
}

/// Turns the derivative by what the activation gave into the derivative by what went into it.
Values before(policy::Activation activation, Values by_activated, const Values& activated) {
  for (std::size_t i = 0; i < activated.size(); ++i) {
    const double x = activated[i];
    by_activated[i] *= activation == policy::Activation::kTanh ? 1.0 - x * x : (x > 0.0 ? 1.0 : 0.0);
  }
  return by_activated;
}

/// What each hidden layer gives, and last the logits.
std::vector<Values> outputs_of(const policy::Network& network, std::span<const double> observation) {
  std::vector<Values> outputs;
  std::span<const double> input = observation;
  const std::size_t last = network.hidden_count();
  for (std::size_t l = 0; l < last; ++l) {
    outputs.push_back(activate(network.activation, apply(network.layer(l), input)));
    input = outputs.back();
  }
  outputs.push_back(apply(network.layer(last), input));
  return outputs;
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
  return outputs_of(network, observation).back();
}

LogProbability log_probability(const policy::Network& network, std::span<const double> observation, std::size_t action) {
  assert(observation.size() == network.observation_size && action < network.action_count);
  const std::vector<Values> outputs = outputs_of(network, observation);
  const LogProbability by_logit = of_logits(outputs.back(), action);
  Values gradient = by_logit.gradient;
  for (std::size_t l = network.hidden_count(); l > 0; --l)
    gradient = before(network.activation, transposed(network.layer(l), gradient), outputs[l - 1]);
  return {.value = by_logit.value, .gradient = transposed(network.layer(0), gradient)};
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
