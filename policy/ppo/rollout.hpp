#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "policy/ppo/actor_critic.hpp"

namespace earshot::ppo {

/// The steps of all environments between two updates. Sample (step t, environment e) stands at index e * steps + t, as Stable-Baselines3
/// flattens it.
struct Rollout {
  Rollout(NetworkShape shape, std::size_t environments, std::size_t steps_each)
      : steps(steps_each),
        observations(shape.observation_size, static_cast<Eigen::Index>(environments * steps_each)),
        actions(environments * steps_each),
        log_probabilities(environments * steps_each),
        values(environments * steps_each),
        rewards(environments * steps_each),
        episode_starts(environments * steps_each),
        advantages(environments * steps_each),
        returns(environments * steps_each) {}

  [[nodiscard]] std::size_t size() const { return actions.size(); }

  std::size_t steps;           ///< of each environment
  Matrix<float> observations;  ///< [observation_size x samples]
  std::vector<std::uint8_t> actions;
  std::vector<float> log_probabilities;      ///< of the action when it was taken
  std::vector<float> values;                 ///< V(observation) when it was seen
  std::vector<float> rewards;                ///< with gamma V(final observation) added where the time limit cut the episode
  std::vector<std::uint8_t> episode_starts;  ///< 1 where the observation is an episode's first
  std::vector<float> advantages;
  std::vector<float> returns;  ///< advantage + value
};

}  // namespace earshot::ppo
