#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "policy/ppo/actor_critic.hpp"
#include "policy/ppo/hyper_parameters.hpp"

namespace earshot::ppo {

/// A minibatch, or a slice of one, as PPO's loss needs it; all spans of one size.
template <class Scalar>
struct Samples {
  std::span<const std::uint8_t> actions;
  std::span<const Scalar> old_log_probabilities;
  std::span<Scalar> advantages;  ///< normalised in place
  std::span<const Scalar> returns;
  std::size_t minibatch_size = 0;  ///< samples of the whole minibatch
};

/// Figures of a minibatch: means over its samples; of a slice of it, the slice's part of them.
template <class Scalar>
struct LossTerms {
  Scalar total{0};           ///< L
  Scalar policy{0};          ///< mean(-min(r A, clip(r) A))
  Scalar value{0};           ///< mean((R - V)^2)
  Scalar entropy{0};         ///< mean(H), nats
  Scalar approximate_kl{0};  ///< mean(r - 1 - log r) >= 0, nats; Source: Schulman, "Approximating KL divergence", 2020
  Scalar clip_fraction{0};   ///< of the samples, |r - 1| > c

  LossTerms& operator+=(const LossTerms& more);
};

/// (A - mean) / (standard deviation + 1e-8), the standard deviation with n - 1; a single sample is left as it is.
/// Oracle: NormaliseAdvantages.*
template <class Scalar>
void normalise(std::span<Scalar> advantages);

/// PPO's loss, or a slice's part of it, and its gradient with respect to logits and values.
///
///   L = mean(-min(r A, clip(r, 1 - c, 1 + c) A)) + c_v mean((R - V)^2) - c_e mean(H),  r = pi(a|o) / pi_old(a|o)
///
/// @param logits    [actions x batch]; becomes log-probabilities
/// @param d_logits  [actions x batch] dL/dlogits
/// @param d_values  [1 x batch] dL/dvalues
/// Source: Schulman et al. 2017, Eq. 7 and 9.   Oracle: Loss.*, Update.*
template <class Scalar>
LossTerms<Scalar> ppo_loss(const Samples<Scalar>& samples, const HyperParameters& hyper, Matrix<Scalar>& logits,
                           const Matrix<Scalar>& values, Matrix<Scalar>& d_logits, Matrix<Scalar>& d_values);

}  // namespace earshot::ppo
