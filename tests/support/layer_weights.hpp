#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace earshot::tests {

/// Sets the weights of a layer of policy::Network. @param rows  one of `inputs` weights for each output
template <class Layer>
void set_weights(Layer& layer, std::size_t inputs, std::initializer_list<float> rows) {
  std::size_t i = 0;
  for (const float weight : rows) {
    layer.weight(i / inputs, i % inputs) = weight;
    ++i;
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
