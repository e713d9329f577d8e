#include "policy/ppo/actor_critic.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "policy/ppo/loss.hpp"

namespace earshot::ppo {
namespace {

constexpr NetworkShape kShape{6, 8};
constexpr Eigen::Index kBatch = 5;

/// The whole loss of a minibatch as a function of the parameters.
class WholeLoss {
 public:
  WholeLoss() {
    Pcg32 random(11);
    networks.initialise(random);
    for (double& p : networks.parameters()) p += 0.1 * (random.uniform_double() - 0.5);  // biases too, logits no longer near zero
    observations = Matrix<double>::NullaryExpr(kShape.observation_size, kBatch, [&] { return 2.0 * random.uniform_double() - 1.0; });
    hyper.entropy_coefficient = 0.05;
    // Ratios within the clip range: the loss is smooth there. Clipping itself: loss_test.cpp.
    networks.forward(observations.data(), kBatch, activations);
    for (Eigen::Index i = 0; i < kBatch; ++i) {
      const double log_sum = std::log(activations.logits.col(i).array().exp().sum());
      old[static_cast<std::size_t>(i)] =
          activations.logits(actions[static_cast<std::size_t>(i)], i) - log_sum + 0.1 * (random.uniform_double() - 0.5);
    }
  }

  double operator()() {
    networks.forward(observations.data(), kBatch, activations);
    return ppo_loss<double>({actions, old, advantages, returns, actions.size()}, hyper, activations.logits, activations.values, d_logits,
                            d_values)
        .total;
  }

  ActorCritic<double> networks{kShape};
  Matrix<double> observations;
  Activations<double> activations{kShape, kBatch};
  Matrix<double> d_logits{kShape.action_count, kBatch};
  Matrix<double> d_values{1, kBatch};
  HyperParameters hyper;
  std::array<std::uint8_t, 5> actions{0, 3, 7, 3, 5};
  std::array<double, 5> old{};
  std::array<double, 5> advantages{1.0, -0.5, 0.3, -2.0, 0.8};
  std::array<double, 5> returns{3.0, -1.0, 0.5, 2.0, -4.0};
};

TEST(ActorCritic, GradientMatchesFiniteDifferences) {
  WholeLoss loss;
  loss();
  std::vector<double> gradient(loss.networks.parameters().size());
  loss.networks.backward(loss.observations.data(), kBatch, loss.activations, loss.d_logits, loss.d_values, gradient);
  constexpr double kStep = 1e-5;
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    double& p = loss.networks.parameters()[i];
    const double kept = p;
    p = kept + kStep;
    const double above = loss();
    p = kept - kStep;
    const double below = loss();
    p = kept;
    // Central differences err by step^2 / 6 times a third derivative of order 10, and by 1e-16 / step times the loss: 1e-9 together.
    ASSERT_NEAR(gradient[i], (above - below) / (2.0 * kStep), 5e-9) << "parameter " << i;
  }
}

TEST(ActorCritic, GivesASampleTheSameOutputsAloneAndInABatch) {
  ActorCritic<float> networks(kShape);
  Pcg32 random(2);
  networks.initialise(random);
  const Matrix<float> observations = Matrix<float>::NullaryExpr(6, 64, [&] { return 2.0F * random.uniform_float() - 1.0F; });
  Activations<float> together(kShape, 64);
  Activations<float> alone(kShape, 1);
  networks.forward(observations.data(), 64, together);
  for (Eigen::Index i = 0; i < 64; ++i) {
    networks.forward(observations.col(i).data(), 1, alone);
    EXPECT_NEAR(alone.values(0, 0), together.values(0, i), 1e-5F);  // sums of 64 floats of order 1 in another order
    EXPECT_LT((alone.logits.col(0) - together.logits.col(i)).cwiseAbs().maxCoeff(), 1e-6F);
  }
}

TEST(ActorCritic, StartsWithSmallLogitsSoThatEveryActionIsAboutAsLikely) {
  ActorCritic<float> networks(kShape);
  Pcg32 random(2);
  networks.initialise(random);
  const Matrix<float> observation = Matrix<float>::Ones(6, 1);
  Activations<float> activations(kShape, 1);
  networks.forward(observation.data(), 1, activations);
  // |logits| <= gain * |64 tanh units| <= 0.01 * 8.
  EXPECT_LE(activations.logits.norm(), 0.08F);
}

}  // namespace
}  // namespace earshot::ppo
