// Row network.forward_ns: how long the shipped policy's network takes for one observation, on the widest vector unit that this machine has.
#include <array>
#include <span>

#include "firmware/host/policy/unverified_policy.hpp"
#include "firmware/policy/network.hpp"
#include "tests/bench/nanoseconds.hpp"

int main() {
  using namespace earshot;
  const auto policy = host::load_unverified_policy(EARSHOT_SOURCE_DIR "/policy/frozen/shipped.policy");
  std::array<float, config::kMaxActions> logits{};
  const std::span<float> scores = std::span(logits).first(policy->actions.size());
  bench::print_nanoseconds(policy->observation.spec.size(), [&](std::span<const float> observation) {
    policy::forward(policy->network, observation, scores);
    return scores.front();
  });
}
