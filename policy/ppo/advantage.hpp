#pragma once

#include <cstdint>
#include <span>

namespace earshot::ppo {

/// One environment's part of a rollout, step by step. All of one size.
struct Trajectory {
  std::span<const float> rewards;                ///< of the step taken at t, with gamma V(final observation) added where truncated
  std::span<const float> values;                 ///< V(observation at t)
  std::span<const std::uint8_t> episode_starts;  ///< 1 where the observation at t is an episode's first
  float next_value = 0.0F;                       ///< V(observation after the last step)
  bool next_starts_episode = false;              ///< the last step ended an episode
};

/// Generalised advantage estimation.
///
///   delta_t = r_t + gamma V_{t+1} (1 - d_{t+1}) - V_t
///   A_t = delta_t + gamma lambda (1 - d_{t+1}) A_{t+1}
///
/// where d_{t+1} = 1 when the step at t ended an episode.
/// @param advantages  A_t, of the trajectory's size
/// Source: Schulman et al. 2016, arXiv:1506.02438, Eq. 16; indices as Stable-Baselines3's RolloutBuffer.   Oracle: Advantage.*
void estimate_advantages(const Trajectory& trajectory, double discount, double gae_lambda, std::span<float> advantages);

}  // namespace earshot::ppo
