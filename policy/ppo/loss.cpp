#include "policy/ppo/loss.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace earshot::ppo {
namespace {

/// logits -> logits - log sum exp(logits), column by column, and their exponentials.
template <class Scalar>
void log_softmax(Eigen::Index batch, Matrix<Scalar>& logits, Matrix<Scalar>& probabilities) {
  for (Eigen::Index i = 0; i < batch; ++i) logits.col(i).array() -= logits.col(i).maxCoeff();
  probabilities.leftCols(batch) = logits.leftCols(batch).array().exp();
  for (Eigen::Index i = 0; i < batch; ++i) {
    const Scalar sum = probabilities.col(i).sum();
    logits.col(i).array() -= std::log(sum);
    probabilities.col(i) /= sum;
  }
}

}  // namespace

template <class Scalar>
void normalise(std::span<Scalar> advantages) {
  if (advantages.size() < 2) return;
  Eigen::Map<Eigen::Array<Scalar, Eigen::Dynamic, 1>> a(advantages.data(), static_cast<Eigen::Index>(advantages.size()));
  a -= a.mean();
  const Scalar deviation = std::sqrt(a.square().sum() / static_cast<Scalar>(advantages.size() - 1));
  a /= deviation + Scalar{1e-8F};
}

template <class Scalar>
LossTerms<Scalar>& LossTerms<Scalar>::operator+=(const LossTerms& more) {
  total += more.total;
  policy += more.policy;
  value += more.value;
  entropy += more.entropy;
  approximate_kl += more.approximate_kl;
  clip_fraction += more.clip_fraction;
  return *this;
}

template <class Scalar>
LossTerms<Scalar> ppo_loss(const Samples<Scalar>& samples, const HyperParameters& hyper, Matrix<Scalar>& logits,
                           const Matrix<Scalar>& values, Matrix<Scalar>& d_logits, Matrix<Scalar>& d_values) {
  const std::size_t batch = samples.actions.size();
  const auto one_over_batch = Scalar{1} / static_cast<Scalar>(samples.minibatch_size);
  const auto clip = static_cast<Scalar>(hyper.clip_range);
  const auto value_weight = static_cast<Scalar>(hyper.value_coefficient);
  const auto entropy_weight = static_cast<Scalar>(hyper.entropy_coefficient);
  log_softmax(static_cast<Eigen::Index>(batch), logits, d_logits);

  LossTerms<Scalar> sums;
  for (std::size_t i = 0; i < batch; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const auto action = static_cast<Eigen::Index>(samples.actions[i]);
    const Scalar advantage = samples.advantages[i];
    const Scalar log_ratio = logits(action, column) - samples.old_log_probabilities[i];
    const Scalar ratio = std::exp(log_ratio);
    const Scalar clipped = std::clamp(ratio, Scalar{1} - clip, Scalar{1} + clip);
    const bool moves = ratio * advantage <= clipped * advantage;
    sums.policy -= std::min(ratio * advantage, clipped * advantage);
    sums.approximate_kl += ratio - Scalar{1} - log_ratio;
    sums.clip_fraction += std::abs(ratio - Scalar{1}) > clip ? Scalar{1} : Scalar{0};

    auto d = d_logits.col(column);  // holds the probabilities
    const Scalar entropy = -(d.array() * logits.col(column).array()).sum();
    sums.entropy += entropy;
    const Scalar towards = moves ? -advantage * ratio * one_over_batch : Scalar{0};
    if (entropy_weight != Scalar{0}) {
      d = d.array() * (entropy_weight * one_over_batch * (logits.col(column).array() + entropy) - towards);
    } else {
      d *= -towards;
    }
    d(action) += towards;

    const Scalar error = values(0, column) - samples.returns[i];
    sums.value += error * error;
    d_values(0, column) = Scalar{2} * value_weight * one_over_batch * error;
  }
  LossTerms<Scalar> means{Scalar{0},
                          sums.policy * one_over_batch,
                          sums.value * one_over_batch,
                          sums.entropy * one_over_batch,
                          sums.approximate_kl * one_over_batch,
                          sums.clip_fraction * one_over_batch};
  means.total = means.policy + value_weight * means.value - entropy_weight * means.entropy;
  return means;
}

template struct LossTerms<float>;
template struct LossTerms<double>;
template void normalise<float>(std::span<float>);
template void normalise<double>(std::span<double>);
template LossTerms<float> ppo_loss<float>(const Samples<float>&, const HyperParameters&, Matrix<float>&, const Matrix<float>&,
                                          Matrix<float>&, Matrix<float>&);
template LossTerms<double> ppo_loss<double>(const Samples<double>&, const HyperParameters&, Matrix<double>&, const Matrix<double>&,
                                            Matrix<double>&, Matrix<double>&);

}  // namespace earshot::ppo
