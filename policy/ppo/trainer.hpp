#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "policy/ppo/learner.hpp"
#include "sim/search/vector_search.hpp"

namespace earshot::ppo {

/// PPO on the search task: collects rollouts and learns from them. Same seed, same policy, on one kind of processor.
class Trainer {
 public:
  /// @param world  outlives this
  Trainer(const search::SearchWorld& world, const policy::ObservationModel& model, const HyperParameters& hyper, std::uint64_t seed);

  /// Told of every finished episode and the steps taken so far in all environments; false ends training at once (the rollout under way is
  /// dropped).
  using OnEpisode = std::function<bool(const search::EpisodeRecord& episode, std::uint64_t steps)>;

  /// Rollouts and updates until at least `steps` steps are taken (whole rollouts, as Stable-Baselines3) or `on_episode` returns false.
  void train(std::uint64_t steps, const OnEpisode& on_episode);

  [[nodiscard]] const ActorCritic<float>& networks() const { return learner_.networks(); }
  /// The last steps taken, all of a rollout once train() has returned of itself.
  [[nodiscard]] const Rollout& rollout() const { return rollout_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }

 private:
  bool collect(const OnEpisode& on_episode);
  void choose_actions(std::size_t t);
  void keep_outcomes(std::size_t t);
  [[nodiscard]] std::size_t draw(Eigen::Index environment, float& log_probability);
  [[nodiscard]] float value_of(std::span<const float> observation);
  void estimate();

  HyperParameters hyper_;
  Pcg32 random_;
  search::VectorSearch environments_;
  Learner learner_;
  Rollout rollout_;
  Matrix<float> observations_;  // [observation_size x environments]
  Activations<float> activations_;
  Activations<float> single_;
  std::vector<std::size_t> actions_;
  std::vector<std::uint8_t> episode_starts_;
  std::uint64_t steps_ = 0;
};

}  // namespace earshot::ppo
