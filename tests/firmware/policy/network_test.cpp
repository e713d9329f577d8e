#include "firmware/policy/network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
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
    for (float& weight : layer.weights) weight = random.uniform_float() - 0.5F;
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
        for (std::size_t j = 0; j < values.size(); ++j)
          next[i] += static_cast<long double>(layer.weights[i * values.size() + j]) * values[j];
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

TEST(Forward, GivesTheSameBitsOnEveryMachine) {
  const auto network = random_network(63, 64, 64, 32);
  std::vector<float> logits(32);
  forward(*network, random_observation(63), logits);
  std::uint32_t crc = 0;
  for (const float logit : logits) crc = crc32(std::bit_cast<std::array<std::uint8_t, 4>>(logit), crc);
  EXPECT_EQ(crc, 0xFE413A35U);  // GCC 12 at -O0 and -O3, x86-64, aarch64 and 32-bit ARM alike
}

}  // namespace
}  // namespace earshot::policy
