#include "policy/ppo/trainer.hpp"

#include <algorithm>
#include <cmath>

#include "policy/ppo/advantage.hpp"

namespace earshot::ppo {
namespace {

constexpr std::uint64_t kLearningStream = 0xEA25'4073ULL;  // apart from the environments' streams 0, 1, 2...

Eigen::Index index(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}

NetworkShape shape_of(const search::VectorSearch& environments) {
  return {index(environments.observation_size()), index(environments.action_count())};
}

}  // namespace

Trainer::Trainer(const search::SearchWorld& world, const policy::ObservationModel& model, const HyperParameters& hyper, std::uint64_t seed)
    : hyper_(hyper),
      random_(seed, kLearningStream),
      environments_(world, model, hyper.environment_count, seed),
      learner_(shape_of(environments_), hyper, random_),
      rollout_(shape_of(environments_), hyper.environment_count, hyper.steps_per_rollout),
      observations_(index(model.spec.size()), index(hyper.environment_count)),
      activations_(shape_of(environments_), index(hyper.environment_count)),
      single_(shape_of(environments_), 1),
      actions_(hyper.environment_count),
      episode_starts_(hyper.environment_count, 1) {}

void Trainer::train(std::uint64_t steps, const OnEpisode& on_episode) {
  while (steps_ < steps && collect(on_episode)) {
    estimate();
    learner_.update(rollout_, random_);
  }
}

bool Trainer::collect(const OnEpisode& on_episode) {
  for (std::size_t t = 0; t < hyper_.steps_per_rollout; ++t) {
    choose_actions(t);
    environments_.step(actions_);
    steps_ += hyper_.environment_count;
    keep_outcomes(t);
    for (std::size_t e = 0; e < hyper_.environment_count; ++e) {
      if (episode_starts_[e] != 0 && !on_episode(environments_.ended(e), steps_)) return false;
    }
  }
  return true;
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
    float reward = environments_.reward(e);
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
