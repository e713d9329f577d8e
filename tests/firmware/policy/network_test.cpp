#include "firmware/policy/network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/core/random.hpp"
#include "tests/support/hand_computed_network.hpp"

namespace earshot::policy {
namespace {

std::unique_ptr<Network> random_network(std::size_t observation, std::size_t hidden_one, std::size_t hidden_two, std::size_t actions) {
  auto network = std::make_unique<Network>();
  network->observation_size = observation;
  network->hidden_sizes = {hidden_one, hidden_two};
  network->action_count = actions;
  Pcg32 random(11);
  const auto fill = [&random](auto& layer) {
    for (float& weight : layer.packed) weight = random.uniform_float() - 0.5F;
    for (float& bias : layer.bias) bias = random.uniform_float() - 0.5F;
  };
  fill(network->first);
  fill(network->second);
  fill(network->output);
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

TEST(Forward, AgreesWithLongDoubleArithmeticForEverySizeOfLayer) {
  for (const std::size_t size : {1U, 2U, 7U, 8U, 9U, 33U, 64U}) {
    const auto network = random_network(size, size, size, std::min<std::size_t>(size, 32));
    const std::vector<float> observation = random_observation(size);
    std::vector<float> logits(network->action_count);
    forward(*network, observation, logits);

    std::vector<long double> values(observation.begin(), observation.end());
    const auto apply = [&values](const auto& layer, std::size_t outputs) {
      std::vector<long double> next(outputs);
      for (std::size_t i = 0; i < outputs; ++i) {
        next[i] = static_cast<long double>(layer.bias[i]);
        for (std::size_t j = 0; j < values.size(); ++j) next[i] += static_cast<long double>(layer.weight(i, j)) * values[j];
      }
      values = next;
    };
    apply(network->first, size);
    for (long double& value : values) value = std::tanh(value);
    apply(network->second, size);
    for (long double& value : values) value = std::tanh(value);
    apply(network->output, logits.size());
    for (std::size_t i = 0; i < logits.size(); ++i) {
      EXPECT_NEAR(static_cast<double>(logits[i]), static_cast<double>(values[i]), 1e-5) << size;  // ~100 float roundings of sums below 10
    }
  }
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

TEST(Forward, GivesTheSameBitsOnEveryMachine) {
  const auto network = random_network(63, 64, 64, 32);
  const std::vector<float> observation = random_observation(63);
  for (const auto [unit, name] : kUnits) {
    if (!has(unit)) {
      std::printf("not compared, for this machine or compiler has it not: %s\n", name);
      continue;
    }
    std::vector<float> logits(32);
    forward_on(unit, *network, observation, logits);
    EXPECT_EQ(checksum(logits), 0x439ADB6EU) << name;  // GCC 12 at -O0 and -O3, x86-64 and aarch64 alike
  }
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
  EXPECT_EQ(network->hidden_sizes, (std::array<std::size_t, 2>{}));
  EXPECT_EQ(network->action_count, 0U);
}

TEST(Forward, GivesTheSameBitsOnEveryVectorUnitForEverySizeOfLayer) {
  for (const std::size_t size : {1U, 2U, 3U, 5U, 8U, 15U, 16U, 17U, 33U, 62U, 64U}) {
    const auto network = random_network(size, size, 65 - size, std::min<std::size_t>(size, 32));
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
  const auto clean = random_network(3, 5, 6, 7);
  const auto dirty = random_network(3, 5, 6, 7);
  const auto spoil = [](auto& layer, std::size_t outputs, std::size_t inputs) {
    for (std::size_t o = 0; o < layer.bias.size(); ++o) {
      for (std::size_t i = 0; i < layer.packed.size() / layer.bias.size(); ++i) {
        if (o >= outputs || i >= inputs) layer.weight(o, i) = std::numeric_limits<float>::quiet_NaN();
      }
    }
    for (std::size_t o = outputs; o < layer.bias.size(); ++o) layer.bias[o] = std::numeric_limits<float>::infinity();
  };
  spoil(dirty->first, 5, 3);
  spoil(dirty->second, 6, 5);
  spoil(dirty->output, 7, 6);
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
      network_->second.weight(i, i) = 0x1p-40F;
      network_->output.weight(i, i) = 0x1p40F;
    }
  }
  std::array<float, kCount> operator()(std::span<const float, kCount> numbers) {
    std::ranges::copy(numbers, network_->first.bias.begin());
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
    network.second.weight(0, 0) = 0x1p-40F;
    network.output.weight(0, 0) = 0x1p40F;
    const auto of = [&](float x) {
      network.first.bias[0] = x;
      std::array<float, 1> result{};
      forward_on(unit, network, std::array{0.0F}, result);
      return result[0];
    };
    EXPECT_EQ(of(std::numeric_limits<float>::infinity()), 1.0F) << name;
    EXPECT_EQ(of(-std::numeric_limits<float>::infinity()), -1.0F) << name;
    EXPECT_TRUE(std::isnan(of(std::numeric_limits<float>::quiet_NaN()))) << name;
  }
}

}  // namespace
}  // namespace earshot::policy
