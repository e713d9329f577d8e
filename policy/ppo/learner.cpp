#include "policy/ppo/learner.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace earshot::ppo {
namespace {

void shuffle(std::span<std::uint32_t> order, Pcg32& random) {
  for (std::size_t i = order.size(); i > 1; --i) {
    const auto j = static_cast<std::size_t>((static_cast<std::uint64_t>(random.next()) * i) >> 32U);
    std::swap(order[i - 1], order[j]);
  }
}

Eigen::Index index(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}

}  // namespace

Learner::Learner(NetworkShape shape, const HyperParameters& hyper, Pcg32& random)
    : hyper_(hyper),
      networks_(shape),
      adam_(networks_.parameters().size()),
      gradient_(networks_.parameters().size()),
      order_(hyper.environment_count * hyper.steps_per_rollout),
      observations_(shape.observation_size, index(hyper.batch_size)),
      actions_(hyper.batch_size),
      log_probabilities_(hyper.batch_size),
      advantages_(hyper.batch_size),
      returns_(hyper.batch_size),
      activations_(shape, index(hyper.batch_size)),
      d_logits_(shape.action_count, index(hyper.batch_size)),
      d_values_(1, index(hyper.batch_size)) {
  networks_.initialise(random);
}

void Learner::update(const Rollout& rollout, Pcg32& random) {
  std::iota(order_.begin(), order_.end(), 0U);
  for (std::size_t epoch = 0; epoch < hyper_.epochs; ++epoch) {
    shuffle(order_, random);
    run_epoch(rollout, order_);
  }
}

void Learner::run_epoch(const Rollout& rollout, std::span<const std::uint32_t> order) {
  for (std::size_t start = 0; start < order.size(); start += hyper_.batch_size) {
    run_minibatch(rollout, order.subspan(start, std::min(hyper_.batch_size, order.size() - start)));
  }
}

void Learner::run_minibatch(const Rollout& rollout, std::span<const std::uint32_t> samples) {
  const std::size_t batch = samples.size();
  for (std::size_t i = 0; i < batch; ++i) {
    const std::uint32_t sample = samples[i];
    observations_.col(index(i)) = rollout.observations.col(sample);
    actions_[i] = rollout.actions[sample];
    log_probabilities_[i] = rollout.log_probabilities[sample];
    advantages_[i] = rollout.advantages[sample];
    returns_[i] = rollout.returns[sample];
  }
  const std::span advantages = std::span(advantages_).first(batch);
  normalise(advantages);
  networks_.forward(observations_.data(), index(batch), activations_);
  const Samples<float> seen{std::span<const std::uint8_t>(actions_).first(batch), std::span<const float>(log_probabilities_).first(batch),
                            advantages, std::span<const float>(returns_).first(batch)};
  ppo_loss(seen, hyper_, activations_.logits, activations_.values, d_logits_, d_values_);
  networks_.backward(observations_.data(), index(batch), activations_, d_logits_, d_values_, gradient_);
  clip_gradient(gradient_, hyper_.max_gradient_norm);
  adam_.step(networks_.parameters(), gradient_, hyper_.learning_rate);
}

}  // namespace earshot::ppo
