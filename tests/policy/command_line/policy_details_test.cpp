#include "policy/command_line/policy_details.hpp"

#include <gtest/gtest.h>

namespace earshot::command_line {
namespace {

/// 64 units of 2 inputs take 64 * 3 numbers of 4 bytes, 64 of those 64 * 65, a layer of 8 actions 8 * 65.
TEST(NetworkText, HasTheShapeAndTheMemoryOfANetwork) {
  policy::Network network;
  network.observation_size = 2;
  network.action_count = 8;
  EXPECT_EQ(network_text(network), "no network");
  network.hidden_sizes = {64, 64};
  EXPECT_EQ(network_text(network), "network 64-64 tanh of 19488 bytes");
  network.hidden_sizes = {256, 100, 7};
  network.activation = policy::Activation::kRelu;
  // 256 * 3, 128 places for 100 units of 256 inputs, 64 for 7 of 100, 8 of 7 inputs.
  EXPECT_EQ(network_text(network), "network 256-100-7 ReLU of 160768 bytes");
}

}  // namespace
}  // namespace earshot::command_line
