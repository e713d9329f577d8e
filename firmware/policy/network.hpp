#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware/config/capacities.hpp"

namespace earshot::policy {

/// A multilayer perceptron with tanh hidden layers and a linear output (the actor of the policy), weights in place.
struct Network {
  /// One dense layer: output = weights * input + bias; weights row-major [outputs x inputs] and packed: the layer's own number of inputs,
  /// not MaxInputs, lies between two rows.
  template <std::size_t MaxOutputs, std::size_t MaxInputs>
  struct Layer {
    std::array<float, MaxOutputs * MaxInputs> weights{};
    std::array<float, MaxOutputs> bias{};
  };
  static constexpr std::size_t kWidth = config::kMaxLayerWidth;

  std::size_t observation_size = 0;
  std::array<std::size_t, config::kMaxHiddenLayers> hidden_sizes{};  ///< units per hidden layer; exactly two layers
  std::size_t action_count = 0;
  Layer<kWidth, config::kMaxObservation> first;
  Layer<kWidth, kWidth> second;
  Layer<config::kMaxActions, kWidth> output;
};

/// Logits of every action for one observation. Same bits on every machine: one fixed order of IEEE float operations, no fused multiply-add.
/// @param observation  [observation_size]
/// @param logits       [action_count]
/// Oracle: Forward.EqualsAHandComputedNetwork, Forward.GivesTheSameBitsOnEveryMachine
void forward(const Network& network, std::span<const float> observation, std::span<float> logits);

}  // namespace earshot::policy
