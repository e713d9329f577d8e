#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/policy/network.hpp"

namespace earshot::explain {

struct NetworkSizes {
  std::size_t observation;
  std::array<std::size_t, 3> hidden;
  std::size_t actions;
  policy::Activation activation = policy::Activation::kTanh;
};

/// Weights and biases uniform in [-largest, largest).
inline std::unique_ptr<policy::Network> random_network(const NetworkSizes& sizes, float largest, Pcg32& random) {
  auto network = std::make_unique<policy::Network>();
  network->observation_size = sizes.observation;
  network->hidden_sizes = sizes.hidden;
  network->action_count = sizes.actions;
  network->activation = sizes.activation;
  for (std::size_t l = 0; l <= network->hidden_count(); ++l) {
    for (float& weight : network->layer(l).packed) weight = largest * (2.0F * random.uniform_float() - 1.0F);
    for (float& bias : network->layer(l).bias) bias = largest * (2.0F * random.uniform_float() - 1.0F);
  }
  return network;
}

inline std::vector<double> random_observation(std::size_t size, Pcg32& random) {
  std::vector<double> observation(size);
  for (double& value : observation) value = 2.0 * random.uniform_double() - 1.0;
  return observation;
}

}  // namespace earshot::explain
