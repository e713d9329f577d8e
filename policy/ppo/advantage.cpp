#include "policy/ppo/advantage.hpp"

#include <cassert>
#include <cstddef>

namespace earshot::ppo {

void estimate_advantages(const Trajectory& trajectory, double discount, double gae_lambda, std::span<float> advantages) {
  assert(advantages.size() == trajectory.rewards.size());
  const auto gamma = static_cast<float>(discount);
  const auto gamma_lambda = static_cast<float>(discount * gae_lambda);
  float advantage = 0.0F;
  float next_value = trajectory.next_value;
  float goes_on = trajectory.next_starts_episode ? 0.0F : 1.0F;
  for (std::size_t t = advantages.size(); t-- > 0;) {
    const float delta = trajectory.rewards[t] + gamma * next_value * goes_on - trajectory.values[t];
    advantage = delta + gamma_lambda * goes_on * advantage;
    advantages[t] = advantage;
    next_value = trajectory.values[t];
    goes_on = trajectory.episode_starts[t] != 0 ? 0.0F : 1.0F;
  }
}

}  // namespace earshot::ppo
