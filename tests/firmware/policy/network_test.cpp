#include "firmware/policy/network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/core/random.hpp"
#include "tests/support/hand_computed_network.hpp"
#include "tests/support/layer_weights.hpp"

namespace earshot::policy {
namespace {

constexpr std::size_t kPlaces = Network::kBlock;

/// @param inputs_drawn  of the first layer: numbers are drawn for as many, and those of none that it has are dropped
std::unique_ptr<Network> random_network(std::size_t observation, std::initializer_list<std::size_t> hidden, std::size_t actions,
                                        std::size_t inputs_drawn = 0) {
  auto network = std::make_unique<Network>();
  network->observation_size = observation;
  std::copy(hidden.begin(), hidden.end(), network->hidden_sizes.begin());
  network->action_count = actions;
  Pcg32 random(11);
  for (std::size_t l = 0; l <= hidden.size(); ++l) {
    const Network::Layer layer = network->layer(l);
    for (float& weight : layer.packed) weight = random.uniform_float() - 0.5F;
    for (std::size_t i = layer.packed.size(); l == 0 && i < inputs_drawn * kPlaces; ++i) static_cast<void>(random.uniform_float());
    for (float& bias : layer.bias) bias = random.uniform_float() - 0.5F;
  }
  return network;
}

std::vector<float> random_observation(std::size_t size) {
  Pcg32 random(12);
  std::vector<float> observation(size);
  for (float& value : observation) value = 2.0F * random.uniform_float() - 1.0F;
  return observation;
}

TEST(Forward, EqualsAHandComputedNetwork) {
  const auto network = tests::hand_computed_network();
  std::array<float, 2> logits{};
  forward(*network, std::array{0.5F, -0.25F}, logits);
  EXPECT_NEAR(logits[0], 4.8501707F, 2e-6F);  // four roundings of a float near 4
  EXPECT_NEAR(logits[1], -1.9250854F, 1e-6F);
}

std::vector<long double> long_double_logits(const Network& network, std::span<const float> observation) {
  std::vector<long double> values(observation.begin(), observation.end());
  for (std::size_t l = 0; l <= network.hidden_count(); ++l) {
    const Network::ConstLayer layer = network.layer(l);
    std::vector<long double> next(layer.outputs);
    for (std::size_t i = 0; i < next.size(); ++i) {
      next[i] = static_cast<long double>(layer.bias[i]);
      for (std::size_t j = 0; j < values.size(); ++j) next[i] += static_cast<long double>(layer.weight(i, j)) * values[j];
      if (l == network.hidden_count()) continue;
      next[i] = network.activation == Activation::kTanh ? std::tanh(next[i]) : std::max(next[i], 0.0L);
    }
    values = next;
  }
  return values;
}

void expect_long_doubles(const Network& network, double tolerance) {
  const std::vector<float> observation = random_observation(network.observation_size);
  std::vector<float> logits(network.action_count);
  forward(network, observation, logits);
  const std::vector<long double> expected = long_double_logits(network, observation);
  for (std::size_t i = 0; i < logits.size(); ++i)
    EXPECT_NEAR(static_cast<double>(logits[i]), static_cast<double>(expected[i]), tolerance) << network.hidden_sizes[0];
}

TEST(Forward, AgreesWithLongDoubleArithmeticForEverySizeOfLayer) {
  for (const std::size_t size : {1U, 2U, 7U, 8U, 9U, 33U, 64U})
    expect_long_doubles(*random_network(size, {size, size}, std::min<std::size_t>(size, config::kMaxActions)),
                        1e-5);  // ~100 float roundings of sums below 10
}

TEST(Forward, AgreesWithLongDoubleArithmeticForOneToThreeLayersOfTheirOwnSizes) {
  for (const auto& hidden : {std::initializer_list<std::size_t>{40}, {3, 50}, {50, 3}, {30, 7, 19}, {1, 60, 2}}) {
    const auto network = random_network(6, hidden, 8);
    expect_long_doubles(*network, 1e-5);
    network->activation = Activation::kRelu;
    expect_long_doubles(*network, 1e-4);  // sums up to some hundreds
  }
}

TEST(Forward, AgreesWithLongDoubleArithmeticForTheWidestLayers) {
  if (config::kMaxLayerWidth < 256) GTEST_SKIP() << "this program holds none of 256 units";
  for (const auto& hidden : {std::initializer_list<std::size_t>{256, 256, 256}, {255, 65, 130}, {256}}) {
    const auto network = random_network(64, hidden, 32);
    expect_long_doubles(*network, 3e-5);  // ~500 roundings of sums below 10
    network->activation = Activation::kRelu;
    for (float& weight : network->numbers) weight *= 0.25F;  // else the sums grow eightfold with each layer
    expect_long_doubles(*network, 3e-5);
  }
}

/// By hand: units of 1 * 0.5 - 2 * 0.25 + 0.25 = 0.25 and of -3 * 0.5 - 0.5 * 0.25 - 1, below zero; logits 4 * 0.25 + 1 and -2 * 0.25.
TEST(Forward, EqualsAHandComputedNetworkOfOneLayerWithRelu) {
  Network network;
  network.observation_size = 2;
  network.hidden_sizes = {2};
  network.action_count = 2;
  network.activation = Activation::kRelu;
  tests::set_weights(network.layer(0), 2, {1.0F, 2.0F, -3.0F, 0.5F});
  network.layer(0).bias[0] = 0.25F;
  network.layer(0).bias[1] = -1.0F;
  tests::set_weights(network.layer(1), 2, {4.0F, 100.0F, -2.0F, 100.0F});
  network.layer(1).bias[0] = 1.0F;
  std::array<float, 2> logits{};
  forward(network, std::array{0.5F, -0.25F}, logits);
  EXPECT_EQ(logits, (std::array{2.0F, -0.5F}));
}

struct NamedUnit {
  VectorUnit unit;
  const char* name;
};
constexpr std::array kUnits = {NamedUnit{VectorUnit::kNone, "float by float"}, NamedUnit{VectorUnit::k128Bits, "SSE2 or NEON"},
                               NamedUnit{VectorUnit::kAvx2, "AVX2"}, NamedUnit{VectorUnit::kAvx512, "AVX-512"}};

std::uint32_t checksum(std::span<const float> values) {
  std::uint32_t crc = 0;
  for (const float value : values) crc = crc32(std::bit_cast<std::array<std::uint8_t, 4>>(value), crc);
  return crc;
}

/// Of its logits on every vector unit.
void expect_bits(const Network& network, std::uint32_t expected) {
  const std::vector<float> observation = random_observation(network.observation_size);
  for (const auto [unit, name] : kUnits) {
    if (!has(unit)) {
      std::printf("not compared, for this machine or compiler has it not: %s\n", name);
      continue;
    }
    std::vector<float> logits(network.action_count);
    forward_on(unit, network, observation, logits);
    EXPECT_EQ(checksum(logits), expected) << name;
  }
}

TEST(Forward, GivesTheSameBitsOnEveryMachine) {
  expect_bits(*random_network(63, {64, 64}, 32, 64), 0x439ADB6EU);  // GCC 12 at -O0 and -O3, x86-64 and aarch64 alike
}

TEST(Forward, GivesTheSameBitsOfOneToThreeLayersOnEveryMachine) {
  const auto network = random_network(6, {30, 7, 19}, 8);
  expect_bits(*network, 0x72338005U);
  network->activation = Activation::kRelu;
  expect_bits(*network, 0x2D840D64U);
  expect_bits(*random_network(6, {50}, 8), 0x905C6159U);
}

TEST(Forward, GivesTheSameBitsOfThreeLayersOf256UnitsOnEveryMachine) {
  if (config::kMaxLayerWidth < 256) GTEST_SKIP() << "this program holds none of 256 units";
  const auto network = random_network(62, {256, 256, 256}, 8);
  expect_bits(*network, 0x89AB2CA0U);
  network->activation = Activation::kRelu;
  expect_bits(*network, 0x43746AA8U);
}

TEST(VectorUnit, IsNotThereWhereNobodyKnowsIt) {
  EXPECT_TRUE(has(VectorUnit::kNone));
  EXPECT_FALSE(has(static_cast<VectorUnit>(4)));
}

#if defined(__SSE2__) || defined(__aarch64__)
TEST(VectorUnit, IsOf128BitsOnEveryProcessorThatThisCompilerBuildsFor) {
  EXPECT_TRUE(has(VectorUnit::k128Bits));
}
#endif

TEST(Network, HasNoSizesUntilItIsGivenSome) {
  const auto network = std::make_unique<Network>();
  EXPECT_EQ(network->observation_size, 0U);
  EXPECT_EQ(network->hidden_sizes, (std::array<std::size_t, 3>{}));
  EXPECT_EQ(network->action_count, 0U);
}

TEST(Forward, GivesTheSameBitsOnEveryVectorUnitForEverySizeOfLayer) {
  for (const std::size_t size : {1U, 2U, 3U, 5U, 8U, 15U, 16U, 17U, 33U, 62U, 64U}) {
    const auto network = random_network(size, {size, 65 - size}, std::min<std::size_t>(size, config::kMaxActions));
    const std::vector<float> observation = random_observation(size);
    std::vector<float> float_by_float(network->action_count);
    forward_on(VectorUnit::kNone, *network, observation, float_by_float);
    std::vector<float> logits(network->action_count);
    forward(*network, observation, logits);
    EXPECT_EQ(checksum(logits), checksum(float_by_float)) << size;
    for (const auto [unit, name] : kUnits) {
      if (!has(unit)) continue;
      forward_on(unit, *network, observation, logits);
      EXPECT_EQ(checksum(logits), checksum(float_by_float)) << name << ", " << size;
    }
  }
}

TEST(Forward, NeverReadsWhatLiesBeyondTheSizeOfALayer) {
  const auto clean = random_network(3, {5, 6}, 7);
  const auto dirty = random_network(3, {5, 6}, 7);
  const auto spoil = [](const Network::Layer& layer, std::size_t outputs) {
    for (std::size_t o = 0; o < layer.bias.size(); ++o) {
      for (std::size_t i = 0; i < layer.inputs; ++i) {
        if (o >= outputs) layer.weight(o, i) = std::numeric_limits<float>::quiet_NaN();
      }
    }
    for (std::size_t o = outputs; o < layer.bias.size(); ++o) layer.bias[o] = std::numeric_limits<float>::infinity();
  };
  spoil(dirty->layer(0), 5);
  spoil(dirty->layer(1), 6);
  spoil(dirty->layer(2), 7);
  for (const auto [unit, name] : kUnits) {
    if (!has(unit)) continue;
    std::vector<float> expected(7);
    std::vector<float> logits(7);
    forward_on(unit, *clean, random_observation(3), expected);
    forward_on(unit, *dirty, random_observation(3), logits);
    EXPECT_EQ(logits, expected) << name;
  }
}

/// tanh of 32 numbers at a time as the hidden units compute it. What follows the first layer only shifts exponents: 2^-40 is so small that
/// the second tanh gives it back bit for bit, and 2^40 undoes it. Good for results from 2^-60 up.
class HiddenTanh {
 public:
  static constexpr std::size_t kCount = 32;
  HiddenTanh() {
    network_->observation_size = 1;
    network_->hidden_sizes = {kCount, kCount};
    network_->action_count = kCount;
    for (std::size_t i = 0; i < kCount; ++i) {
      network_->layer(1).weight(i, i) = 0x1p-40F;
      network_->layer(2).weight(i, i) = 0x1p40F;
    }
  }
  std::array<float, kCount> operator()(std::span<const float, kCount> numbers) {
    std::ranges::copy(numbers, network_->layer(0).bias.begin());
    std::array<float, kCount> results{};
    forward(*network_, std::array{0.0F}, results);
    return results;
  }

 private:
  std::unique_ptr<Network> network_ = std::make_unique<Network>();
};

/// Calls `visit` with one float of every 401 from 2^-60 to `largest` and its tanh, and so with every exponent.
template <class Visit>
void for_tanh_up_to(float largest, Visit visit) {
  HiddenTanh tanh;
  std::array<float, HiddenTanh::kCount> numbers{};
  for (std::uint32_t bits = std::bit_cast<std::uint32_t>(0x1p-60F); bits < std::bit_cast<std::uint32_t>(largest);) {
    for (float& x : numbers) {
      x = std::bit_cast<float>(bits);
      bits += 401;
    }
    const auto results = tanh(numbers);
    for (std::size_t i = 0; i < numbers.size(); ++i) visit(numbers[i], results[i]);
  }
}

TEST(Tanh, IsThatOfTheLibraryWithinSevenStepsOfAFloat) {
  double worst = 0.0;
  for_tanh_up_to(20.0F, [&worst](float x, float got) {
    const double exact = std::tanh(double{x});
    worst = std::max(worst, std::fabs(double{got} - exact) / exact);
  });
  EXPECT_LE(worst, 4.2e-7);  // all floats: 4.14e-7, of which the fit is 2.2e-8 and the rest a dozen roundings
  EXPECT_GE(worst, 3e-7);    // else this looks at something else
}

TEST(Tanh, IsNeverBeyondOneAndOneFromWhereItRoundsToOne) {
  for_tanh_up_to(0x1p127F, [](float x, float got) {
    ASSERT_LE(got, 1.0F) << x;
    if (x >= 9.5F) {
      ASSERT_EQ(got, 1.0F) << x;
    }
  });
}

TEST(Tanh, IsNeverBeyondMinusOneEither) {
  HiddenTanh tanh;
  std::array<float, HiddenTanh::kCount> numbers{};
  for (int i = 0; i < 100; ++i) {
    for (std::size_t lane = 0; lane < numbers.size(); ++lane)
      numbers[lane] = -8.9F - 1e-4F * static_cast<float>(static_cast<std::size_t>(i) * numbers.size() + lane);  // to -9.22
    for (const float result : tanh(numbers)) ASSERT_GE(result, -1.0F);
  }
}

TEST(Tanh, IsOddAndKeepsInfinityAndNan) {
  HiddenTanh tanh;
  std::array<float, HiddenTanh::kCount> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = 0.37F * static_cast<float>(i);
  const auto above = tanh(numbers);
  for (float& x : numbers) x = -x;
  const auto below = tanh(numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(below[i], -above[i]);
  // A NaN would reach every logit, as nothing times NaN: one unit alone.
  for (const auto [unit, name] : kUnits) {
    if (!has(unit)) continue;
    Network network;
    network.observation_size = 1;
    network.hidden_sizes = {1, 1};
    network.action_count = 1;
    network.layer(1).weight(0, 0) = 0x1p-40F;
    network.layer(2).weight(0, 0) = 0x1p40F;
    const auto of = [&](float x) {
      network.layer(0).bias[0] = x;
      std::array<float, 1> result{};
      forward_on(unit, network, std::array{0.0F}, result);
      return result[0];
    };
    EXPECT_EQ(of(std::numeric_limits<float>::infinity()), 1.0F) << name;
    EXPECT_EQ(of(-std::numeric_limits<float>::infinity()), -1.0F) << name;
    EXPECT_TRUE(std::isnan(of(std::numeric_limits<float>::quiet_NaN()))) << name;
  }
}

/// In a unit whose sum is below zero, too: a broken weight of a hidden layer must not look like a unit that is off.
TEST(Relu, KeepsWhatIsAboveZeroAndNanAndNothingElse) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const auto [unit, name] : kUnits) {
    if (!has(unit)) continue;
    Network network;
    network.observation_size = 1;
    network.hidden_sizes = {1};
    network.action_count = 1;
    network.activation = Activation::kRelu;
    network.layer(1).weight(0, 0) = 1.0F;
    const auto of = [&](float x) {
      network.layer(0).bias[0] = x;
      std::array<float, 1> result{};
      forward_on(unit, network, std::array{0.0F}, result);
      return result[0];
    };
    for (const float x : {0.0F, 1e-40F, 1.0F, 3e38F, kInfinity}) EXPECT_EQ(of(x), x) << name;
    for (const float x : {-0.0F, -1e-40F, -1.0F, -3e38F, -kInfinity}) EXPECT_EQ(of(x), 0.0F) << name << ' ' << x;
    EXPECT_TRUE(std::isnan(of(std::numeric_limits<float>::quiet_NaN()))) << name;
    EXPECT_TRUE(std::isnan(of(-std::numeric_limits<float>::quiet_NaN()))) << name;
  }
}

TEST(Network, TakesTheBytesOfItsWeightsInBlocks) {
  Network network;
  network.observation_size = 6;
  network.hidden_sizes = {65, 3, 64};
  network.action_count = 9;
  // 65 units take 128 places, 3 take 64, 9 actions 16: 128 * 7 + 64 * 66 + 64 * 4 + 16 * 65 numbers.
  EXPECT_EQ(bytes_of_numbers(network), 4U * 6416U);
  network.hidden_sizes = {65'535, 65'535, 65'535};
  EXPECT_EQ(bytes_of_numbers(network), 4U * (65'536ULL * 7 + 2ULL * 65'536 * 65'536 + 16ULL * 65'536));
}

TEST(Network, HasAShapeOnlyWithLayersThatFollowEachOther) {
  Network network;
  const auto is_shape = [&network](std::array<std::size_t, 3> sizes) {
    network.hidden_sizes = sizes;
    return has_shape(network);
  };
  network.observation_size = network.action_count = 1;
  EXPECT_TRUE(is_shape({1}));
  EXPECT_TRUE(is_shape({65'535, 1, 1}));
  EXPECT_FALSE(is_shape({}));
  EXPECT_FALSE(is_shape({1, 0, 1}));
  EXPECT_FALSE(is_shape({0, 1}));
  EXPECT_FALSE(is_shape({65'536}));
  EXPECT_FALSE(is_shape({std::size_t{1} << 31U, 1}));
}

}  // namespace
}  // namespace earshot::policy
