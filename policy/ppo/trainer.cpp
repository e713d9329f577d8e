#include "policy/ppo/trainer.hpp"

#include <algorithm>
#include <cmath>

#include "policy/ppo/advantage.hpp"
#include "sim/search/streams.hpp"

namespace earshot::ppo {
namespace {

constexpr std::uint64_t kLearningStream = 0xEA25'4073ULL;  // apart from the environments' streams 0, 1, 2...

Eigen::Index index(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}

NetworkShape shape_of(const search::VectorSearch& environments) {
  return {index(environments.observation_size()), index(environments.action_count())};
}

parallel::Ranks& one_process() {
  static parallel::Alone alone;  // has no state
  return alone;
}

/// Source: Stable-Baselines3 2.3.2, explained_variance.
double explained_variance(const Rollout& rollout) {
  const auto size = index(rollout.size());
  const Eigen::ArrayXd returns = Eigen::Map<const Eigen::ArrayXf>(rollout.returns.data(), size).cast<double>();
  const Eigen::ArrayXd errors = returns - Eigen::Map<const Eigen::ArrayXf>(rollout.values.data(), size).cast<double>();
  const double spread = (returns - returns.mean()).square().sum();
  return spread > 0.0 ? 1.0 - (errors - errors.mean()).square().sum() / spread : 0.0;
}

}  // namespace

Trainer::Trainer(const search::World& world, const policy::ObservationModel& model, const policy::OceanTables& tables,
                 const HyperParameters& hyper, std::uint64_t seed)
    : Trainer(world, model, tables, hyper, seed, one_process()) {}

Trainer::Trainer(const search::World& world, const policy::ObservationModel& model, const policy::OceanTables& tables,
                 const HyperParameters& hyper, std::uint64_t seed, parallel::Ranks& ranks)
    : Trainer(std::span(&world, 1), model, tables, hyper, seed, ranks) {}

Trainer::Trainer(std::span<const search::World> worlds, const policy::ObservationModel& model, const policy::OceanTables& tables,
                 const HyperParameters& hyper, std::uint64_t seed, parallel::Ranks& ranks)
    : hyper_(hyper),
      seed_(seed),
      ranks_(ranks),
      random_(search::training_random(seed, kLearningStream)),
      environments_(worlds, model, tables, hyper.environment_count, seed, ranks.rank() * hyper.environment_count),
      learner_(shape_of(environments_), hyper, random_, ranks),
      rollout_(shape_of(environments_), hyper.environment_count, hyper.steps_per_rollout),
      observations_(index(model.spec.size()), index(hyper.environment_count)),
      activations_(shape_of(environments_), index(hyper.environment_count)),
      single_(shape_of(environments_), 1),
      actions_(hyper.environment_count),
      episode_starts_(hyper.environment_count, 1) {
  // The weights are everyone's, what is drawn now is not.
  if (ranks.rank() > 0) random_ = search::training_random(seed, kLearningStream + ranks.rank());
}

void Trainer::train(std::uint64_t steps, const OnEpisode& on_episode) {
  bool goes_on = true;
  const OnEpisode on_each = [&](const search::EpisodeRecord& episode, std::uint64_t at) {
    goes_on = on_episode(episode, at) && goes_on;
    return goes_on;
  };
  while (steps_ < steps && goes_on) advance(on_each);
}

UpdateReport Trainer::advance(const OnEpisode& on_episode) {
  collect(on_episode);
  estimate();
  UpdateReport report = learner_.update(rollout_, learning_rate(), random_);
  report.explained_variance = explained_variance(rollout_);
  return report;
}

TrainingState Trainer::state() const {
  return {.steps = steps_, .seed = seed_, .optimiser = learner_.optimiser(), .workers = {{random_.state(), environments_.scripts()}}};
}

bool Trainer::resume(std::span<const float> parameters, const TrainingState& state) {
  const std::size_t size = learner_.networks().parameters().size();
  if (parameters.size() != size || state.optimiser.first_moment.size() != size || state.optimiser.second_moment.size() != size)
    return false;
  if (state.workers.size() != ranks_.size() || state.seed != seed_) return false;
  const WorkerState& mine = state.workers[ranks_.rank()];
  if (!environments_.resume(mine.episodes)) return false;
  learner_.resume(parameters, state.optimiser);
  random_ = Pcg32(mine.random);
  steps_ = state.steps;
  for (std::size_t e = 0; e < episode_starts_.size(); ++e) episode_starts_[e] = mine.episodes[e].actions.empty() ? 1 : 0;
  return true;
}

/// Falls as Stable-Baselines3's linear schedules do: by the steps taken when the update begins.
double Trainer::learning_rate() const {
  if (hyper_.decay_steps == 0) return hyper_.learning_rate;
  return hyper_.learning_rate * std::max(0.0, 1.0 - static_cast<double>(steps_) / static_cast<double>(hyper_.decay_steps));
}

void Trainer::collect(const OnEpisode& on_episode) {
  for (std::size_t t = 0; t < hyper_.steps_per_rollout; ++t) {
    choose_actions(t);
    environments_.step(actions_);
    steps_ += hyper_.environment_count * ranks_.size();
    keep_outcomes(t);
    for (std::size_t e = 0; e < hyper_.environment_count; ++e) {
      if (episode_starts_[e] != 0) on_episode(environments_.ended(e), steps_);
    }
  }
}

void Trainer::choose_actions(std::size_t t) {
  for (std::size_t e = 0; e < hyper_.environment_count; ++e) {
    std::ranges::copy(environments_.observation(e), observations_.col(index(e)).data());
  }
  learner_.networks().forward(observations_.data(), observations_.cols(), activations_);
  for (std::size_t e = 0; e < hyper_.environment_count; ++e) {
    const std::size_t sample = e * rollout_.steps + t;
    actions_[e] = draw(index(e), rollout_.log_probabilities[sample]);
    rollout_.observations.col(index(sample)) = observations_.col(index(e));
    rollout_.actions[sample] = static_cast<std::uint8_t>(actions_[e]);
    rollout_.values[sample] = activations_.values(0, index(e));
    rollout_.episode_starts[sample] = episode_starts_[e];
  }
}

void Trainer::keep_outcomes(std::size_t t) {
  for (std::size_t e = 0; e < hyper_.environment_count; ++e) {
    const search::EpisodeEnd end = environments_.ended(e).end;
    float reward = hyper_.reward.of(environments_.reward(e), end);
    if (end == search::EpisodeEnd::kTimeLimit) reward += static_cast<float>(hyper_.discount) * value_of(environments_.final_observation(e));
    rollout_.rewards[e * rollout_.steps + t] = reward;
    episode_starts_[e] = end != search::EpisodeEnd::kRunning ? 1 : 0;
  }
}

/// Draws from the softmax of one environment's logits by the inverse of its cumulative distribution.
std::size_t Trainer::draw(Eigen::Index environment, float& log_probability) {
  auto logits = activations_.logits.col(environment).array();
  logits -= logits.maxCoeff();
  const float sum = logits.exp().sum();
  const float threshold = random_.uniform_float() * sum;
  float cumulative = 0.0F;
  Eigen::Index action = 0;
  for (; action + 1 < logits.size(); ++action) {
    cumulative += std::exp(logits(action));
    if (threshold < cumulative) break;
  }
  log_probability = logits(action) - std::log(sum);
  return static_cast<std::size_t>(action);
}

float Trainer::value_of(std::span<const float> observation) {
  learner_.networks().forward(observation.data(), 1, single_);
  return single_.values(0, 0);
}

void Trainer::estimate() {
  for (std::size_t e = 0; e < hyper_.environment_count; ++e) {
    const std::size_t begin = e * rollout_.steps;
    const Trajectory trajectory{std::span<const float>(rollout_.rewards).subspan(begin, rollout_.steps),
                                std::span<const float>(rollout_.values).subspan(begin, rollout_.steps),
                                std::span<const std::uint8_t>(rollout_.episode_starts).subspan(begin, rollout_.steps),
                                value_of(environments_.observation(e)), episode_starts_[e] != 0};
    const std::span<float> advantages = std::span(rollout_.advantages).subspan(begin, rollout_.steps);
    estimate_advantages(trajectory, hyper_.discount, hyper_.gae_lambda, advantages);
    for (std::size_t t = begin; t < begin + rollout_.steps; ++t) rollout_.returns[t] = rollout_.advantages[t] + rollout_.values[t];
  }
}

}  // namespace earshot::ppo
