#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"

namespace earshot::policy {

/// A multilayer perceptron with tanh hidden layers and a linear output (the actor of the policy), weights in place.
struct Network {
  /// One dense layer: output = weights * input + bias. Packed for a vector unit: outputs come in blocks of kBlock, and the weights of one
  /// input to all outputs of a block lie side by side, just before those of the next input. Places of outputs that a network has not are
  /// computed with their block and never read.
  template <std::size_t MaxOutputs, std::size_t MaxInputs, std::size_t Block>
  struct Layer {
    static constexpr std::size_t kBlock = Block;
    static constexpr std::size_t kCacheLine = 64;  // bytes
    static_assert(MaxOutputs % kBlock == 0);

    alignas(kCacheLine) std::array<float, MaxOutputs * MaxInputs> packed{};
    alignas(kCacheLine) std::array<float, MaxOutputs> bias{};

    [[nodiscard]] static constexpr std::size_t place(std::size_t output, std::size_t input) {
      return (output / kBlock * MaxInputs + input) * kBlock + output % kBlock;
    }
    [[nodiscard]] float& weight(std::size_t output, std::size_t input) { return packed[place(output, input)]; }
    [[nodiscard]] float weight(std::size_t output, std::size_t input) const { return packed[place(output, input)]; }
  };
  static constexpr std::size_t kWidth = config::kMaxLayerWidth;

  std::size_t observation_size = 0;
  std::array<std::size_t, config::kMaxHiddenLayers> hidden_sizes{};  ///< units per hidden layer; exactly two layers
  std::size_t action_count = 0;
  Layer<kWidth, config::kMaxObservation, kWidth> first;
  Layer<kWidth, kWidth, kWidth> second;
  Layer<config::kMaxActions, kWidth, 8> output;  ///< eight directions are one block
};

/// Whether there is one; else the belief's own advice flies.
[[nodiscard]] bool has_network(const Network& network);

/// Logits of every action for one observation, on the widest vector unit that this machine has. Same bits on every machine and unit, for
/// every output is a sum of its own in one fixed order of IEEE float operations, none of them fused (x inputs, w weights, b bias):
///
///   hidden   tanh(((b + w_0 x_0) + w_1 x_1) + ...)
///   output   (s_0 + s_1) + (s_2 + s_3),   s_k = the sum in that order of every fourth product from the k-th on; s_0 starts from b
///
///   tanh x = x P(x^2) / Q(x^2), both of degree 4; at most 4.2e-7 of it from the true value (seven steps of a float below one), never
///   beyond +-1
///
/// @param network      has_network()
/// @param observation  [observation_size]
/// @param logits       [action_count]
/// Error: at most 5e-6 on 10 000 observations of searches by each policy that ships (logits reach 16); no bound for any observation.
/// Oracle: Forward.*, ShippedDecisions.AreThoseOfDoublePrecision
void forward(const Network& network, std::span<const float> observation, std::span<float> logits);

/// What forward() can compute with.
enum class VectorUnit : std::uint8_t {
  kNone,     ///< float by float: a Cortex-M7
  k128Bits,  ///< SSE2 on x86-64, NEON on ARM
  kAvx2,
  kAvx512,
};

/// Whether this machine has it, and this program was built for it.
[[nodiscard]] bool has(VectorUnit unit);

/// forward() on a given unit. @param unit  has() it
void forward_on(VectorUnit unit, const Network& network, std::span<const float> observation, std::span<float> logits);

}  // namespace earshot::policy
