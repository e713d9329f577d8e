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
#include "sim/parallel/ranks.hpp"

namespace earshot::ppo {

/// Figures of one update: means over its minibatches.
struct UpdateReport {
  double policy_loss = 0.0;
  double value_loss = 0.0;
  double entropy = 0.0;             ///< nats
  double approximate_kl = 0.0;      ///< nats
  double clip_fraction = 0.0;       ///< 0 to 1
  double gradient_norm = 0.0;       ///< before clipping
  double explained_variance = 0.0;  ///< 1 - Var(returns - values) / Var(returns) over the rollout; of the values before the update
  double learning_rate = 0.0;
  std::size_t minibatches = 0;  ///< fewer than epochs would make where the target KL ended the update
};

/// Learns from rollouts: the networks, their optimiser and the scratch of a minibatch. Allocates only when made.
class Learner {
 public:
  /// @param random  makes the initial weights; the same on all ranks
  /// @param ranks   those that learn together, each from its own rollout; outlives this
  Learner(NetworkShape shape, const HyperParameters& hyper, Pcg32& random, parallel::Ranks& ranks);

  /// `epochs` passes over the rollout in minibatches, each pass in a fresh random order.
  UpdateReport update(const Rollout& rollout, double learning_rate, Pcg32& random);

  /// One pass over the rollout in the given order of samples, added up in `sums`; false when the target KL ended it.
  bool run_epoch(const Rollout& rollout, std::span<const std::uint32_t> order, double learning_rate, UpdateReport& sums);

  [[nodiscard]] const Adam::State& optimiser() const { return adam_.state(); }
  /// Goes on from there. @param parameters, optimiser  of networks().parameters()' size
  void resume(std::span<const float> parameters, Adam::State optimiser);

  [[nodiscard]] ActorCritic<float>& networks() { return networks_; }
  [[nodiscard]] const ActorCritic<float>& networks() const { return networks_; }

 private:
  std::span<float> gradient_of_parameters() { return std::span(gradient_).first(networks_.parameters().size()); }
  bool run_minibatch(const Rollout& rollout, std::span<const std::uint32_t> samples, double learning_rate, UpdateReport& sums);
  void gather_minibatch(const Rollout& rollout, std::span<const std::uint32_t> samples);
  /// Forward, loss and backward of a slice of the gathered minibatch of so many samples; adds to the gradient.
  LossTerms<float> learn_from(std::size_t first, std::size_t count, std::size_t minibatch);
  void average_over_ranks();

  HyperParameters hyper_;
  ActorCritic<float> networks_;
  Adam adam_;
  parallel::Ranks& ranks_;
  Aligned<float> gradient_;            // and after it what else is averaged over the ranks
  std::vector<float> every_gradient_;  // of all ranks, when there are several
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
