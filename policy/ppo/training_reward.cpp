#include "policy/ppo/training_reward.hpp"

#include <algorithm>

namespace earshot::ppo {

float TrainingReward::of(float reward, search::EpisodeEnd end) const {
  const double bonus = end == search::EpisodeEnd::kFound ? found : 0.0;
  return static_cast<float>(scale * (std::max(double{reward}, least) + step + bonus));
}

void read_training_reward(host::TableReader table, TrainingReward& reward) {
  const host::Range bounds = host::Range::between(-1e6, 1e6);
  reward.found = table.number_or("found", reward.found, bounds);
  reward.step = table.number_or("step", reward.step, bounds);
  reward.least = table.number_or("least", reward.least, host::Range::between(-1.0e9, 0.0));
}

std::vector<std::pair<std::string_view, double>> describe(const TrainingReward& reward) {
  std::vector<std::pair<std::string_view, double>> terms{{"found_reward", reward.found}, {"step_reward", reward.step}};
  if (reward.least > TrainingReward{}.least) terms.emplace_back("least_reward", reward.least);
  terms.emplace_back("reward_scale", reward.scale);
  return terms;
}

}  // namespace earshot::ppo
