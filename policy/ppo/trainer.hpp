#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "policy/ppo/learner.hpp"
#include "sim/search/episode/vector_search.hpp"

namespace earshot::ppo {

/// The part of a training run's state that one process has between two rollouts.
struct WorkerState {
  Pcg32::State random{};
  std::vector<search::EpisodeScript> episodes;  ///< one an environment
};

/// The state of a training run between two rollouts: an interrupted run goes on from it bit for bit.
struct TrainingState {
  std::uint64_t steps = 0;
  std::uint64_t seed = 0;
  Adam::State optimiser;
  std::vector<WorkerState> workers;  ///< one a rank
};

/// PPO on the search task: collects rollouts and learns from them. Same seed, same policy, on one kind of processor.
///
/// Several ranks train one policy together: each steps its own environments and learns from minibatches of its own, and every step of
/// the optimiser takes the mean of their gradients. N ranks are thus as one process with N times the environments and N times the batch,
/// but that each rank shuffles, and normalises advantages, among its own samples.
class Trainer {
 public:
  /// Every episode is in one of the worlds, drawn when it starts (search::VectorSearch).
  /// @param worlds  at least one, of the same settings; they and the tables outlive this, as `ranks` does
  Trainer(std::span<const search::World> worlds, const policy::ObservationModel& model, const policy::OceanTables& tables,
          const HyperParameters& hyper, std::uint64_t seed, parallel::Ranks& ranks);
  /// In one world.
  Trainer(const search::World& world, const policy::ObservationModel& model, const policy::OceanTables& tables,
          const HyperParameters& hyper, std::uint64_t seed, parallel::Ranks& ranks);
  /// Trains in one process.
  Trainer(const search::World& world, const policy::ObservationModel& model, const policy::OceanTables& tables,
          const HyperParameters& hyper, std::uint64_t seed);

  /// Called with every finished episode of this process and the steps taken so far by all; false ends training with the rollout under way.
  using OnEpisode = std::function<bool(const search::EpisodeRecord& episode, std::uint64_t steps)>;

  /// Makes one rollout and one update. What `on_episode` returns does not matter.
  UpdateReport advance(const OnEpisode& on_episode);
  /// Makes whole rollouts and updates, as Stable-Baselines3 does, until at least `steps` steps are taken or `on_episode` returns false. Not
  /// for several ranks, which have to agree on the end.
  void train(std::uint64_t steps, const OnEpisode& on_episode);

  /// The state between two calls of advance(); of the workers it holds this process's own alone.
  [[nodiscard]] TrainingState state() const;
  /// Goes on from there, bit for bit. False when it does not fit this training; only good for destruction then.
  /// @param parameters  networks().parameters() of then
  /// Oracle: TrainerTest.GoesOnFromItsStateAsIfNothingHadHappened
  [[nodiscard]] bool resume(std::span<const float> parameters, const TrainingState& state);

  [[nodiscard]] const ActorCritic<float>& networks() const { return learner_.networks(); }
  [[nodiscard]] const Adam::State& optimiser() const { return learner_.optimiser(); }
  /// The last rollout.
  [[nodiscard]] const Rollout& rollout() const { return rollout_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }

 private:
  void collect(const OnEpisode& on_episode);
  void choose_actions(std::size_t t);
  void keep_outcomes(std::size_t t);
  [[nodiscard]] std::size_t draw(Eigen::Index environment, float& log_probability);
  [[nodiscard]] float value_of(std::span<const float> observation);
  void estimate();
  [[nodiscard]] double learning_rate() const;

  HyperParameters hyper_;
  std::uint64_t seed_;
  parallel::Ranks& ranks_;
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
