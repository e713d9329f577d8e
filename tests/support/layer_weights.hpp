#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <vector>

#include "firmware/policy/network.hpp"

namespace earshot::tests {

/// Sets the weights of a layer of policy::Network. @param rows  one of `inputs` weights for each output
template <class Layer>
void set_weights(const Layer& layer, std::size_t inputs, std::initializer_list<float> rows) {
  std::size_t i = 0;
  for (const float weight : rows) {
    layer.weight(i / inputs, i % inputs) = weight;
    ++i;
  }
}

/// Gives a network another number of inputs, whose weights are zero. All else stays, in its new places.
inline void set_inputs(policy::Network& network, std::size_t inputs) {
  const auto before = std::make_unique<policy::Network>(network);
  network.numbers = {};
  network.observation_size = inputs;
  for (std::size_t l = 0; l <= network.hidden_count(); ++l) {
    const policy::Network::Layer from = before->layer(l);
    std::ranges::copy(from.bias, network.layer(l).bias.begin());
    if (l > 0) std::ranges::copy(from.packed, network.layer(l).packed.begin());
  }
}

/// The weights of a layer of policy::Network [outputs x inputs], row by row.
template <class Layer>
std::vector<float> weights_of(const Layer& layer, std::size_t outputs, std::size_t inputs) {
  std::vector<float> rows;
  for (std::size_t i = 0; i < outputs * inputs; ++i) rows.push_back(layer.weight(i / inputs, i % inputs));
  return rows;
}

}  // namespace earshot::tests
