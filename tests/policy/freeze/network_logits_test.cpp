// Networks of one to three layers, tanh or ReLU, frozen, against PyTorch (tests/oracles/freeze/network_logits.py).

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/policy/network.hpp"
#include "policy/description/search_description.hpp"
#include "policy/freeze/freeze.hpp"
#include "policy/freeze/model_file.hpp"
#include "policy/freeze/thaw.hpp"
#include "tests/policy/freeze/bytes.hpp"

namespace earshot::freeze {
namespace {

constexpr std::array<std::size_t, 5> kWide = {6, 256, 256, 256, 8};

/// weight() of network_logits.py.
float weight(std::uint32_t layer, std::uint32_t place, std::size_t inputs) {
  std::size_t scale = 1;
  while (scale * scale < inputs) scale *= 2;
  return static_cast<float>(4.0 * (test::uniform(100 + layer, place) - 0.5) / static_cast<double>(scale));
}

TrainedActor wide_actor(policy::Activation activation) {
  TrainedActor actor;
  actor.activation = activation;
  for (std::uint32_t l = 0; l + 1 < kWide.size(); ++l) {
    DenseLayer layer{.inputs = kWide[l], .outputs = kWide[l + 1], .weights = {}, .bias = {}};
    std::uint32_t place = 0;
    for (std::size_t i = 0; i < layer.inputs * layer.outputs; ++i) layer.weights.push_back(weight(l, place++, layer.inputs));
    for (std::size_t i = 0; i < layer.outputs; ++i) layer.bias.push_back(weight(l, place++, layer.inputs));
    actor.layers.push_back(layer);
  }
  return actor;
}

/// The search that the models of this folder were trained for: six elements, eight directions.
description::SearchDescription search() {
  return description::from_text(read_model(test::model("memory.zip"), "memory.zip").search.value());
}

std::array<float, 8> logits_of(const policy::Network& network, std::uint32_t i) {
  std::array<float, 6> observation{};
  for (std::uint32_t e = 0; e < observation.size(); ++e) observation[e] = static_cast<float>(3.0 * test::uniform(e, i) - 1.5);
  std::array<float, 8> logits{};
  policy::forward(network, observation, logits);
  return logits;
}

/// @return CRC-32 of all logits, for their bits
std::uint32_t expect_logits_of_torch(const policy::FrozenPolicy& policy, const std::string& name, double tolerance) {
  const nlohmann::json expected = nlohmann::json::parse(test::model("logits.json")).at(name);
  EXPECT_EQ(expected.size(), 50U);
  std::uint32_t crc = 0;
  for (std::uint32_t i = 0; i < expected.size(); ++i) {
    const std::array<float, 8> logits = logits_of(policy.network, i);
    for (std::size_t a = 0; a < logits.size(); ++a) {
      EXPECT_NEAR(static_cast<double>(logits[a]), expected[i][a].get<double>(), tolerance) << name << ' ' << i;
      crc = crc32(std::bit_cast<std::array<std::uint8_t, 4>>(logits[a]), crc);
    }
  }
  return crc;
}

TEST(NetworkLogits, AreThoseOfTorchForModelsOfStableBaselines3) {
  for (const std::string name : {"relu.zip", "three_layers.zip"}) {
    const TrainedActor actor = read_model(test::model(name), name);
    const auto policy = freeze(actor, description::from_text(actor.search.value()), policy::ActionDraw::kArgmax);
    expect_logits_of_torch(*policy, name, 1e-7);  // logits are below 0.02: a float's step there is 2e-9, and a dozen sums round
  }
}

/// Sums of 256 products below 4, rounded some 800 times in a row; the same bits on every machine.
TEST(NetworkLogits, AreThoseOfTorchForThreeLayersOf256UnitsAndTheSameBitsEverywhere) {
  const auto frozen = [](policy::Activation activation) { return freeze(wide_actor(activation), search(), policy::ActionDraw::kArgmax); };
  EXPECT_EQ(expect_logits_of_torch(*frozen(policy::Activation::kTanh), "wide_tanh", 2e-5), 0xE6852176U);
  EXPECT_EQ(expect_logits_of_torch(*frozen(policy::Activation::kRelu), "wide_relu", 2e-5), 0x7480A098U);
}

TEST(NetworkLogits, StayTheSameBitsThroughASignedFile) {
  const auto frozen = freeze(wide_actor(policy::Activation::kRelu), search(), policy::ActionDraw::kSampled);
  const std::vector<std::uint8_t> bytes = sign(*frozen, host::make_key());
  const auto thawed = thaw(bytes, "wide.policy");
  EXPECT_EQ(thawed->network.activation, policy::Activation::kRelu);
  EXPECT_EQ(thawed->network.numbers, frozen->network.numbers);
  for (std::uint32_t i = 0; i < 10; ++i) EXPECT_EQ(logits_of(thawed->network, i), logits_of(frozen->network, i));
}

}  // namespace
}  // namespace earshot::freeze
