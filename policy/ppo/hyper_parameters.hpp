#pragma once

#include <cstddef>
#include <cstdint>

#include "policy/ppo/training_reward.hpp"

namespace earshot::ppo {

/// How PPO learns; defaults are Stable-Baselines3's.
/// Source: Schulman et al. 2017, arXiv:1707.06347; Stable-Baselines3 2.3.2, class PPO.
struct HyperParameters {
  std::size_t environment_count = 1;     ///< environments stepped together, >= 1
  std::size_t steps_per_rollout = 2048;  ///< n_steps: steps of each environment between updates, >= 2
  std::size_t batch_size = 64;           ///< samples of a minibatch, >= 2; the last one of an epoch may be smaller
  std::size_t epochs = 10;               ///< passes over a rollout, >= 1
  double learning_rate = 3e-4;           ///< > 0
  double discount = 0.99;                ///< gamma, 0 to 1
  double gae_lambda = 0.95;              ///< lambda of generalised advantage estimation, 0 to 1
  double clip_range = 0.2;               ///< > 0
  double value_coefficient = 0.5;        ///< weight of the value loss
  double entropy_coefficient = 0.0;      ///< weight of the entropy bonus
  double max_gradient_norm = 0.5;        ///< > 0; actor and critic together
  double target_kl = 0.0;                ///< an update ends early where the policy has moved 1.5 times as far (estimated KL); 0: never
  TrainingReward reward;                 ///< what is learned from, made of the search's own reward
  std::uint64_t decay_steps = 0;         ///< the learning rate falls linearly to zero over so many steps; 0: constant
};

}  // namespace earshot::ppo
