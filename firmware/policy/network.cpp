#include "firmware/policy/network.hpp"

#include <algorithm>
#include <cassert>

// Sums and products below are each rounded by themselves: this file is built with -ffp-contract=off.
namespace earshot::policy {
namespace {

#if defined(__SSE2__) || defined(__aarch64__)
#define EARSHOT_HAS_128_BITS
using Float4 [[gnu::vector_size(16), gnu::may_alias]] = float;
#endif
#if defined(__x86_64__) && defined(__linux__) && !defined(__clang__)
#define EARSHOT_HAS_AVX
using Float8 [[gnu::vector_size(32), gnu::may_alias]] = float;
using Float16 [[gnu::vector_size(64), gnu::may_alias]] = float;
#endif

constexpr std::size_t kMostStated = 65'535;  ///< in two bytes

struct Shape {
  std::size_t inputs;
  std::size_t outputs;
  std::size_t block;
};

Shape shape_of(const Network& network, std::size_t layer) {
  const bool is_last = layer == network.hidden_count();
  return {.inputs = layer == 0 ? network.observation_size : network.hidden_sizes[layer - 1],
          .outputs = is_last ? network.action_count : network.hidden_sizes[layer],
          .block = is_last ? Network::kOutputBlock : Network::kBlock};
}

constexpr std::size_t padded(std::size_t outputs, std::size_t block) {
  return (outputs + block - 1) / block * block;
}

template <class Number>
Network::BasicLayer<Number> layer_in(const Network& network, std::span<Number> numbers, std::size_t index) {
  Shape shape = shape_of(network, 0);
  std::size_t begin = 0;
  for (std::size_t l = 0; l < index; ++l) {
    begin += padded(shape.outputs, shape.block) * (shape.inputs + 1);
    shape = shape_of(network, l + 1);
  }
  const std::size_t outputs = padded(shape.outputs, shape.block);
  return {.inputs = shape.inputs,
          .outputs = shape.outputs,
          .block = shape.block,
          .packed = numbers.subspan(begin, outputs * shape.inputs),
          .bias = numbers.subspan(begin + outputs * shape.inputs, outputs)};
}

template <class Floats>
constexpr std::size_t kLanesOf = sizeof(Floats) / sizeof(float);

// tanh x = x P(x^2) / Q(x^2): relative error at most 4.6e-8 up to kSaturation, beyond which tanh rounds to one. Weighted least squares,
// the weights moved until all the largest errors are equal (Lawson), both constant terms held at one so that tanh x = x for small x.
constexpr float kP1 = 0.133826792F;
constexpr float kP2 = 0.00349744875F;
constexpr float kP3 = 2.06356763e-05F;
constexpr float kP4 = 1.33840867e-08F;
constexpr float kQ1 = 0.467160016F;
constexpr float kQ2 = 0.0258843265F;
constexpr float kQ3 = 0.000328850292F;
constexpr float kQ4 = 7.79016602e-07F;
constexpr float kSaturation = 9.02F;

/// Where x^2 is held at the last place of the fit, x P / Q grows with x, past one. No comparison holds for a NaN, which stays one.
template <class Floats>
[[gnu::always_inline]] inline void apply_tanh(Floats& x) {
  const Floats square = x * x;
  const Floats t = square < kSaturation * kSaturation ? square : Floats{} + kSaturation * kSaturation;
  const Floats p = (((t * kP4 + kP3) * t + kP2) * t + kP1) * t + 1.0F;
  const Floats q = (((t * kQ4 + kQ3) * t + kQ2) * t + kQ1) * t + 1.0F;
  const Floats ratio = x * p / q;
  const Floats below = ratio > 1.0F ? Floats{} + 1.0F : ratio;
  x = below < -1.0F ? Floats{} - 1.0F : below;
}

/// No comparison holds for a NaN, which stays one.
template <class Floats>
[[gnu::always_inline]] inline void apply_relu(Floats& x) {
  x = x < 0.0F ? Floats{} : x;
}

template <class Floats>
[[gnu::always_inline]] inline const Floats& at(const float* values) {
  return *reinterpret_cast<const Floats*>(values);
}

template <class Floats>
[[gnu::always_inline]] inline Floats& at(float* values) {
  return *reinterpret_cast<Floats*>(values);
}

/// The differences between kinds of layers.
struct TanhLayer {
  static constexpr std::size_t kBlock = Network::kBlock;
  static constexpr std::size_t kSums = 1;  // of a layer that is wide enough to keep a vector unit busy
  template <class Floats>
  [[gnu::always_inline]] static void activate(Floats& x) {
    apply_tanh(x);
  }
};
struct ReluLayer {
  static constexpr std::size_t kBlock = Network::kBlock;
  static constexpr std::size_t kSums = 1;
  template <class Floats>
  [[gnu::always_inline]] static void activate(Floats& x) {
    apply_relu(x);
  }
};
struct OutputLayer {
  static constexpr std::size_t kBlock = Network::kOutputBlock;
  static constexpr std::size_t kSums = 4;  // of few outputs, where one sum would wait for itself
  template <class Floats>
  [[gnu::always_inline]] static void activate(Floats& /*x*/) {}
};

/// kBlock vectors of outputs, from `output` on; their sums stay in registers.
template <class Kind, class Floats, std::size_t kBlock>
[[gnu::always_inline]] inline void apply_block(const Network::ConstLayer& layer, std::size_t output, const float* input, float* outputs) {
  constexpr std::size_t kLanes = kLanesOf<Floats>;
  const float* weights = layer.packed.data() + output / Kind::kBlock * Kind::kBlock * layer.inputs + output % Kind::kBlock;
  Floats sums[Kind::kSums][kBlock] = {};
  const auto add = [&](std::size_t sum, float x) __attribute__((always_inline)) {
#pragma GCC unroll 16
    for (std::size_t i = 0; i < kBlock; ++i) sums[sum][i] += at<Floats>(weights + i * kLanes) * x;
    weights += Kind::kBlock;
  };
#pragma GCC unroll 16
  for (std::size_t i = 0; i < kBlock; ++i) sums[0][i] = at<Floats>(layer.bias.data() + output + i * kLanes);
  std::size_t j = 0;
  for (; j + Kind::kSums <= layer.inputs; j += Kind::kSums) {
#pragma GCC unroll 4
    for (std::size_t k = 0; k < Kind::kSums; ++k) add(k, input[j + k]);
  }
#pragma GCC unroll 4
  for (std::size_t k = 0; k + 1 < Kind::kSums; ++k) {
    if (j + k < layer.inputs) add(k, input[j + k]);
  }
#pragma GCC unroll 16
  for (std::size_t i = 0; i < kBlock; ++i) {
    if constexpr (Kind::kSums == 4) sums[0][i] = (sums[0][i] + sums[1][i]) + (sums[2][i] + sums[3][i]);
    Kind::activate(sums[0][i]);
    at<Floats>(outputs + output + i * kLanes) = sums[0][i];
  }
}

/// The outputs of a layer, and as many more as fill the last block. @param outputs  aligned as Floats
template <class Kind, class Floats, std::size_t kBlock>
[[gnu::always_inline]] inline void apply(const Network::ConstLayer& layer, const float* input, float* outputs) {
  constexpr std::size_t kOutputs = kBlock * kLanesOf<Floats>;
  static_assert(Kind::kBlock % kOutputs == 0);
  for (std::size_t output = 0; output < layer.outputs; output += kOutputs) {
    apply_block<Kind, Floats, kBlock>(layer, output, input, outputs);
  }
}

/// @param kBlock, kOutputBlock  vectors of hidden units and of actions at a time: as many sums as hide an addition's latency and fit the
///                              registers
template <class Floats, std::size_t kBlock, class OutputFloats, std::size_t kOutputBlock>
[[gnu::always_inline]] inline void compute(const Network& network, std::span<const float> observation, std::span<float> logits) {
  constexpr std::size_t kAlignment = sizeof(Floats);
  alignas(kAlignment) float buffers[2][Network::kWidth];
  alignas(kAlignment) float output[config::kMaxActions];
  const float* input = observation.data();
  const std::size_t count = network.hidden_count();
  for (std::size_t l = 0; l < count; ++l) {  // in a loop, so that the code is there once
    if (network.activation == Activation::kRelu) {
      apply<ReluLayer, Floats, kBlock>(network.layer(l), input, buffers[l % 2]);
    } else {
      apply<TanhLayer, Floats, kBlock>(network.layer(l), input, buffers[l % 2]);
    }
    input = buffers[l % 2];
  }
  apply<OutputLayer, OutputFloats, kOutputBlock>(network.layer(count), input, output);
  std::copy_n(output, logits.size(), logits.begin());
}

void compute_float_by_float(const Network& network, std::span<const float> observation, std::span<float> logits) {
  compute<float, 4, float, 4>(network, observation, logits);
}

#ifdef EARSHOT_HAS_128_BITS
void compute_with_128_bits(const Network& network, std::span<const float> observation, std::span<float> logits) {
  compute<Float4, 8, Float4, 2>(network, observation, logits);
}
#endif

#ifdef EARSHOT_HAS_AVX
[[gnu::target("avx2")]] void compute_with_avx2(const Network& network, std::span<const float> observation, std::span<float> logits) {
  compute<Float8, 8, Float8, 1>(network, observation, logits);
}

[[gnu::target("avx512f")]] void compute_with_avx512(const Network& network, std::span<const float> observation, std::span<float> logits) {
  compute<Float16, 4, Float8, 1>(network, observation, logits);
}
#endif

}  // namespace

std::size_t Network::hidden_count() const {
  const auto end = std::find(hidden_sizes.begin(), hidden_sizes.end(), std::size_t{0});
  return static_cast<std::size_t>(end - hidden_sizes.begin());
}

Network::ConstLayer Network::layer(std::size_t index) const {
  return layer_in(*this, std::span<const float>(numbers), index);
}

Network::Layer Network::layer(std::size_t index) {
  return layer_in(*this, std::span<float>(numbers), index);
}

bool has_network(const Network& network) {
  return network.hidden_sizes != decltype(network.hidden_sizes){};
}

bool has_shape(const Network& network) {
  const auto& sizes = network.hidden_sizes;
  const auto is_stated = [](std::size_t size) { return size >= 1 && size <= kMostStated; };
  const std::size_t count = network.hidden_count();
  return count > 0 && is_stated(network.observation_size) && is_stated(network.action_count) &&
         std::all_of(sizes.begin(), sizes.begin() + count, is_stated) &&
         std::all_of(sizes.begin() + count, sizes.end(), [](std::size_t size) { return size == 0; });
}

std::uint64_t bytes_of_numbers(const Network& network) {
  std::uint64_t numbers = 0;
  for (std::size_t l = 0; l <= network.hidden_count(); ++l) {
    const Shape shape = shape_of(network, l);
    numbers += std::uint64_t{padded(shape.outputs, shape.block)} * (shape.inputs + 1);
  }
  return sizeof(float) * numbers;
}

bool fits(const Network& network) {
  return std::all_of(network.hidden_sizes.begin(), network.hidden_sizes.end(), [](std::size_t size) { return size <= Network::kWidth; }) &&
         bytes_of_numbers(network) <= sizeof(network.numbers);
}

bool has(VectorUnit unit) {
  switch (unit) {
    case VectorUnit::kNone:
      return true;
#ifdef EARSHOT_HAS_128_BITS
    case VectorUnit::k128Bits:
      return true;
#endif
#ifdef EARSHOT_HAS_AVX
    case VectorUnit::kAvx2:
      return __builtin_cpu_supports("avx2") != 0;
    case VectorUnit::kAvx512:
      return __builtin_cpu_supports("avx512f") != 0;
#endif
    default:
      return false;
  }
}

void forward_on(VectorUnit unit, const Network& network, std::span<const float> observation, std::span<float> logits) {
  assert(has(unit) && observation.size() == network.observation_size && logits.size() == network.action_count);
  switch (unit) {
#ifdef EARSHOT_HAS_128_BITS
    case VectorUnit::k128Bits:
      return compute_with_128_bits(network, observation, logits);
#endif
#ifdef EARSHOT_HAS_AVX
    case VectorUnit::kAvx2:
      return compute_with_avx2(network, observation, logits);
    case VectorUnit::kAvx512:
      return compute_with_avx512(network, observation, logits);
#endif
    default:
      return compute_float_by_float(network, observation, logits);
  }
}

void forward(const Network& network, std::span<const float> observation, std::span<float> logits) {
  for (const VectorUnit unit : {VectorUnit::kAvx512, VectorUnit::kAvx2, VectorUnit::k128Bits}) {
    if (has(unit)) return forward_on(unit, network, observation, logits);
  }
  forward_on(VectorUnit::kNone, network, observation, logits);
}

}  // namespace earshot::policy
