#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"

namespace earshot::policy {

/// What a hidden layer does to each of its sums; its number in a `.policy` file.
enum class Activation : std::uint8_t {
  kTanh = 1,
  kRelu = 2,  ///< x below zero becomes zero; what is no number stays none
};

/// A multilayer perceptron with one to three hidden layers and a linear output (the actor of the policy), weights in place.
struct Network {
  static constexpr std::size_t kWidth = config::kMaxLayerWidth;
  static constexpr std::size_t kBlock = 64;       ///< outputs of a hidden layer that are computed together
  static constexpr std::size_t kOutputBlock = 8;  ///< of the last layer: eight directions
  static constexpr std::size_t kCacheLine = 64;   ///< bytes

  /// One dense layer: output = weights * input + bias. Packed for a vector unit: outputs come in blocks, and the weights of one input to
  /// all outputs of a block lie side by side, just before those of the next input. Places of outputs that a network has not are computed
  /// with their block and never read.
  template <class Number>
  struct BasicLayer {
    std::size_t inputs;
    std::size_t outputs;
    std::size_t block;
    std::span<Number> packed;
    std::span<Number> bias;

    [[nodiscard]] std::size_t place(std::size_t output, std::size_t input) const {
      return (output / block * inputs + input) * block + output % block;
    }
    [[nodiscard]] Number& weight(std::size_t output, std::size_t input) const { return packed[place(output, input)]; }
  };
  using Layer = BasicLayer<float>;
  using ConstLayer = BasicLayer<const float>;

  std::size_t observation_size = 0;
  std::array<std::size_t, config::kMaxHiddenLayers> hidden_sizes{};  ///< units per hidden layer; zero from the first that there is not
  std::size_t action_count = 0;
  Activation activation = Activation::kTanh;
  alignas(kCacheLine) std::array<float, config::kMaxNetworkNumbers> numbers{};  ///< weights and biases, layer after layer

  [[nodiscard]] std::size_t hidden_count() const;
  /// The hidden layers from 0 on, and last, at hidden_count(), the output. Of a network that has a shape and that fits.
  [[nodiscard]] Layer layer(std::size_t index);
  [[nodiscard]] ConstLayer layer(std::size_t index) const;
};

/// Whether there is one; else the belief's own advice flies.
[[nodiscard]] bool has_network(const Network& network);

/// Whether no size is zero, and each is one that two bytes can state.
[[nodiscard]] bool has_shape(const Network& network);

/// Bytes of the weights and biases of a network that has a shape, with the places that fill its blocks.
[[nodiscard]] std::uint64_t bytes_of_numbers(const Network& network);

/// Whether this program holds a network that has a shape: the width of its layers, and all of its numbers.
[[nodiscard]] bool fits(const Network& network);

/// Logits of every action for one observation, on the widest vector unit that this machine has. Same bits on every machine and unit, for
/// every output is a sum of its own in one fixed order of IEEE float operations, none of them fused (x inputs, w weights, b bias):
///
///   hidden   f(((b + w_0 x_0) + w_1 x_1) + ...), f its activation
///   output   (s_0 + s_1) + (s_2 + s_3),   s_k = the sum in that order of every fourth product from the k-th on; s_0 starts from b
///
///   tanh x = x P(x^2) / Q(x^2), both of degree 4; at most 4.2e-7 of it from the true value (seven steps of a float below one), never
///   beyond +-1
///   ReLU x = x, or zero where x < 0, which holds for no NaN: a broken weight shows in the logits
///
/// @param network      has_network(), and check() lets it pass
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
