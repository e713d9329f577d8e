#include "firmware/policy/network.hpp"

#include <cassert>

#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"

namespace earshot::policy {
namespace {

/// Dot product in eight interleaved partial sums, added up pairwise: the order is fixed, and a vector unit of up to eight floats can follow
/// it.
float dot(std::span<const float> a, std::span<const float> b) {
  constexpr std::size_t kLanes = 8;
  std::array<float, kLanes> sums{};
  const std::size_t whole = a.size() - a.size() % kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) sums[lane] += a[i + lane] * b[i + lane];
  }
  for (std::size_t i = whole; i < a.size(); ++i) sums[i - whole] += a[i] * b[i];
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

/// output[i] = dot(row i of weights, input) + bias[i]
template <class Layer>
void apply(const Layer& layer, std::span<const float> input, std::span<float> output) {
  for (std::size_t i = 0; i < output.size(); ++i) {
    output[i] = dot(std::span(layer.weights).subspan(i * input.size(), input.size()), input) + layer.bias[i];
  }
}

void apply_tanh(std::span<float> values) {
  for (float& value : values) value = tanh(value);
}

}  // namespace

EARSHOT_WIDE void forward(const Network& network, std::span<const float> observation, std::span<float> logits) {
  assert(observation.size() == network.observation_size && logits.size() == network.action_count);
  std::array<float, Network::kWidth> first_storage{};
  std::array<float, Network::kWidth> second_storage{};
  const std::span<float> first = std::span(first_storage).first(network.hidden_sizes[0]);
  const std::span<float> second = std::span(second_storage).first(network.hidden_sizes[1]);
  apply(network.first, observation, first);
  apply_tanh(first);
  apply(network.second, first, second);
  apply_tanh(second);
  apply(network.output, second, logits);
}

}  // namespace earshot::policy
