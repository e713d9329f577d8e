#pragma once

#include <algorithm>
#include <array>
#include <memory>

#include "firmware/policy/network.hpp"
#include "tests/support/layer_weights.hpp"

namespace earshot::tests {

/// Two inputs, hidden layers of two units and of one, two outputs: small enough to compute by hand.
///
/// For the input (0.5, -0.25): first layer (0.25, -2.625), tanh (0.2449187, -0.9895597); second 1.9793971, tanh 0.9625427;
/// logits (4.8501707, -1.9250854).
inline std::unique_ptr<policy::Network> hand_computed_network() {
  auto network = std::make_unique<policy::Network>();
  network->observation_size = 2;
  network->hidden_sizes = {2, 1};
  network->action_count = 2;
  set_weights(network->layer(0), 2, {1.0F, 2.0F, -3.0F, 0.5F});
  std::ranges::copy(std::array{0.25F, -1.0F}, network->layer(0).bias.begin());
  set_weights(network->layer(1), 2, {2.0F, -1.0F});
  network->layer(1).bias[0] = 0.5F;
  set_weights(network->layer(2), 1, {4.0F, -2.0F});
  std::ranges::copy(std::array{1.0F, 0.0F}, network->layer(2).bias.begin());
  return network;
}

}  // namespace earshot::tests
