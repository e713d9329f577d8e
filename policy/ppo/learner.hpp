#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/core/random.hpp"
#include "policy/ppo/actor_critic.hpp"
#include "policy/ppo/adam.hpp"
#include "policy/ppo/hyper_parameters.hpp"
#include "policy/ppo/loss.hpp"
#include "policy/ppo/rollout.hpp"

namespace earshot::ppo {

/// Learns from rollouts: the networks, their optimiser and the scratch of a minibatch. Allocates only when made.
class Learner {
 public:
  /// @param random  makes the initial weights
  Learner(NetworkShape shape, const HyperParameters& hyper, Pcg32& random);

  /// `epochs` passes over the rollout in minibatches, each pass in a fresh random order.
  void update(const Rollout& rollout, Pcg32& random);

  /// One pass over the rollout in the given order of samples.
  void run_epoch(const Rollout& rollout, std::span<const std::uint32_t> order);

  [[nodiscard]] ActorCritic<float>& networks() { return networks_; }
  [[nodiscard]] const ActorCritic<float>& networks() const { return networks_; }

 private:
  void run_minibatch(const Rollout& rollout, std::span<const std::uint32_t> samples);

  HyperParameters hyper_;
  ActorCritic<float> networks_;
  Adam adam_;
  Aligned<float> gradient_;
  std::vector<std::uint32_t> order_;
  // The minibatch, gathered.
  Matrix<float> observations_;
  std::vector<std::uint8_t> actions_;
  Aligned<float> log_probabilities_;
  Aligned<float> advantages_;
  Aligned<float> returns_;
  Activations<float> activations_;
  Matrix<float> d_logits_;
  Matrix<float> d_values_;
};

}  // namespace earshot::ppo
