// Row network.forward_ns: how long the network of a policy that sees a belief takes for one observation, on the widest vector unit that
// this machine has. Any weights will do but zeros, which are wrong: none is skipped.
#include <array>
#include <memory>
#include <span>

#include "firmware/core/random.hpp"
#include "firmware/policy/network.hpp"
#include "firmware/policy/observation.hpp"
#include "tests/bench/nanoseconds.hpp"
#include "tests/bench/short_form.hpp"

namespace {

using namespace earshot;

constexpr std::size_t kActions = 8;

std::unique_ptr<policy::Network> any_network() {
  policy::BeliefModel belief;
  for (std::size_t a = 0; a < kActions; ++a) (void)belief.actions.push_back({1, 0});
  auto network = std::make_unique<policy::Network>();
  network->observation_size = policy::belief_state(belief).size();
  network->hidden_sizes = {policy::Network::kWidth, policy::Network::kWidth};
  network->action_count = kActions;
  if (bench::is_wrong_on_purpose()) return network;
  Pcg32 random(7);
  const auto fill = [&random](const auto& layer) {
    for (float& weight : layer.packed) weight = 2.0F * random.uniform_float() - 1.0F;
    for (float& bias : layer.bias) bias = 2.0F * random.uniform_float() - 1.0F;
  };
  fill(network->layer(0));
  fill(network->layer(1));
  fill(network->layer(2));
  return network;
}

}  // namespace

int main() {
  const auto network = any_network();
  std::array<float, kActions> logits{};
  return bench::print_nanoseconds(network->observation_size, [&](std::span<const float> observation) {
    policy::forward(*network, observation, logits);
    return logits.front();
  });
}
