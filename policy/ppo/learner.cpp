#include "policy/ppo/learner.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>
#include <utility>

namespace earshot::ppo {
namespace {

constexpr std::size_t kAveragedTerms = 5;  // of the loss
constexpr std::size_t kSlice = 256;  // samples of a minibatch at a time: what they leave in the networks stays in the second-level cache

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

Learner::Learner(NetworkShape shape, const HyperParameters& hyper, Pcg32& random, parallel::Ranks& ranks)
    : hyper_(hyper),
      networks_(shape),
      adam_(networks_.parameters().size()),
      ranks_(ranks),
      gradient_(networks_.parameters().size() + kAveragedTerms),
      every_gradient_(ranks.size() > 1 ? ranks.size() * gradient_.size() : 0),
      order_(hyper.environment_count * hyper.steps_per_rollout),
      observations_(shape.observation_size, index(hyper.batch_size)),
      actions_(hyper.batch_size),
      log_probabilities_(hyper.batch_size),
      advantages_(hyper.batch_size),
      returns_(hyper.batch_size),
      activations_(shape, index(std::min(hyper.batch_size, kSlice))),
      d_logits_(shape.action_count, index(std::min(hyper.batch_size, kSlice))),
      d_values_(1, index(std::min(hyper.batch_size, kSlice))) {
  networks_.initialise(random);
}

void Learner::resume(std::span<const float> parameters, Adam::State optimiser) {
  assert(parameters.size() == networks_.parameters().size());
  std::ranges::copy(parameters, networks_.parameters().begin());
  adam_.resume(std::move(optimiser));
}

UpdateReport Learner::update(const Rollout& rollout, double learning_rate, Pcg32& random) {
  std::iota(order_.begin(), order_.end(), 0U);
  UpdateReport report;
  bool goes_on = true;
  for (std::size_t epoch = 0; epoch < hyper_.epochs && goes_on; ++epoch) {
    shuffle(order_, random);
    goes_on = run_epoch(rollout, order_, learning_rate, report);
  }
  const auto count = static_cast<double>(report.minibatches);
  for (double* sum :
       {&report.policy_loss, &report.value_loss, &report.entropy, &report.approximate_kl, &report.clip_fraction, &report.gradient_norm}) {
    *sum /= count;
  }
  report.learning_rate = learning_rate;
  return report;
}

bool Learner::run_epoch(const Rollout& rollout, std::span<const std::uint32_t> order, double learning_rate, UpdateReport& sums) {
  for (std::size_t start = 0; start < order.size(); start += hyper_.batch_size) {
    const std::size_t size = std::min(hyper_.batch_size, order.size() - start);
    if (!run_minibatch(rollout, order.subspan(start, size), learning_rate, sums)) return false;
  }
  return true;
}

void Learner::gather_minibatch(const Rollout& rollout, std::span<const std::uint32_t> samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::uint32_t sample = samples[i];
    observations_.col(index(i)) = rollout.observations.col(sample);
    actions_[i] = rollout.actions[sample];
    log_probabilities_[i] = rollout.log_probabilities[sample];
    advantages_[i] = rollout.advantages[sample];
    returns_[i] = rollout.returns[sample];
  }
}

bool Learner::run_minibatch(const Rollout& rollout, std::span<const std::uint32_t> samples, double learning_rate, UpdateReport& sums) {
  const std::size_t batch = samples.size();
  gather_minibatch(rollout, samples);
  normalise(std::span(advantages_).first(batch));
  std::ranges::fill(gradient_, 0.0F);
  LossTerms<float> loss;
  for (std::size_t first = 0; first < batch; first += kSlice) loss += learn_from(first, std::min(kSlice, batch - first), batch);
  const std::span gradient = gradient_of_parameters();
  const std::span averaged = std::span(gradient_).subspan(gradient.size());
  std::ranges::copy(std::array{loss.policy, loss.value, loss.entropy, loss.approximate_kl, loss.clip_fraction}, averaged.begin());
  average_over_ranks();

  sums.minibatches += 1;
  sums.policy_loss += double{averaged[0]};
  sums.value_loss += double{averaged[1]};
  sums.entropy += double{averaged[2]};
  sums.approximate_kl += double{averaged[3]};
  sums.clip_fraction += double{averaged[4]};
  if (hyper_.target_kl > 0.0 && double{averaged[3]} > 1.5 * hyper_.target_kl) return false;
  sums.gradient_norm += clip_gradient(gradient, hyper_.max_gradient_norm);
  adam_.step(networks_.parameters(), gradient, learning_rate);
  return true;
}

LossTerms<float> Learner::learn_from(std::size_t first, std::size_t count, std::size_t minibatch) {
  const float* const observations = observations_.col(index(first)).data();
  networks_.forward(observations, index(count), activations_);
  const Samples<float> seen{std::span<const std::uint8_t>(actions_).subspan(first, count),
                            std::span<const float>(log_probabilities_).subspan(first, count), std::span(advantages_).subspan(first, count),
                            std::span<const float>(returns_).subspan(first, count), minibatch};
  const LossTerms<float> loss = ppo_loss(seen, hyper_, activations_.logits, activations_.values, d_logits_, d_values_);
  networks_.backward(observations, index(count), activations_, d_logits_, d_values_, gradient_of_parameters());
  return loss;
}

/// Every rank adds up in order of rank, so that all have the same bits, whoever came first.
void Learner::average_over_ranks() {
  if (ranks_.size() == 1) return;
  ranks_.gather_everywhere(gradient_, every_gradient_);
  auto map = [this](std::span<float> x) { return Eigen::Map<Eigen::ArrayXf>(x.data(), index(gradient_.size())); };
  auto mean = map(gradient_);
  mean = map(std::span(every_gradient_).first(gradient_.size()));
  for (std::size_t rank = 1; rank < ranks_.size(); ++rank) mean += map(std::span(every_gradient_).subspan(rank * gradient_.size()));
  mean /= static_cast<float>(ranks_.size());
}

}  // namespace earshot::ppo
