#include "policy/explain/network_gradient.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "firmware/policy/action_draw.hpp"
#include "tests/policy/explain/random_network.hpp"
#include "tests/support/hand_computed_network.hpp"

namespace earshot::explain {
namespace {

TEST(LogProbability, EqualsAHandComputedNetwork) {
  const auto network = tests::hand_computed_network();
  const LogProbability p = log_probability(*network, std::array{0.5, -0.25}, 0);
  // By hand: tanh (0.2449187, -0.9895597), second 0.9625427, logits (4.8501707, -1.9250854); p_1 = q = 0.0011403761, log p_0 = log(1 - q);
  // by the second unit 6q (1 - 0.9625427^2), by the first two 2 and -1 times that times their own 1 - tanh^2, by the inputs the weights.
  EXPECT_NEAR(p.value, -0.001141026857315, 1e-15);  // rounding of a double
  EXPECT_NEAR(p.gradient[0], 0.000976970239383, 1e-15);
  EXPECT_NEAR(p.gradient[1], 0.001886030055415, 1e-15);
}

TEST(LogProbability, HasTheGradientThatFiniteDifferencesShow) {
  Pcg32 random(3);
  for (const NetworkSizes& sizes :
       {NetworkSizes{1, {1, 1}, 1}, NetworkSizes{5, {7, 6}, 4}, NetworkSizes{64, {64, 64}, 32}, NetworkSizes{5, {9}, 4},
        NetworkSizes{5, {7, 6, 8}, 4}, NetworkSizes{5, {7, 6, 8}, 4, policy::Activation::kRelu}}) {
    const auto network = random_network(sizes, 0.4F, random);
    std::vector<double> x = random_observation(sizes.observation, random);
    for (std::size_t action = 0; action < sizes.actions; action += 3) {
      const LogProbability here = log_probability(*network, x, action);
      for (std::size_t i = 0; i < x.size(); ++i) {
        constexpr double kStep = 1e-5;
        const double middle = x[i];
        x[i] = middle + kStep;
        const double above = log_probability(*network, x, action).value;
        x[i] = middle - kStep;
        const double below = log_probability(*network, x, action).value;
        x[i] = middle;
        // A central difference is off by the third derivative times kStep^2 (some 1e-9 here) and by 1e-15 / kStep of rounding.
        EXPECT_NEAR(here.gradient[i], (above - below) / (2.0 * kStep), 1e-8);
      }
    }
  }
}

TEST(LogProbability, IsThatOfTheFloatNetworkThatFlies) {
  Pcg32 random(4);
  const auto network = random_network({20, {64, 64}, 8}, 0.4F, random);
  const std::vector<double> x = random_observation(20, random);
  const std::vector<float> observation(x.begin(), x.end());
  std::array<float, 8> logits{};
  std::array<float, 8> probabilities{};
  policy::forward(*network, observation, logits);
  policy::softmax(logits, probabilities);
  const std::vector<double> seen(observation.begin(), observation.end());
  for (std::size_t a = 0; a < logits.size(); ++a) {
    EXPECT_NEAR(std::exp(log_probability(*network, seen, a).value), static_cast<double>(probabilities[a]),
                2e-6);  // some 64 float roundings
    EXPECT_NEAR(logits_of(*network, seen)[a], static_cast<double>(logits[a]), 2e-5);
  }
}

/// Logits log 3 and 0, wherever in the observation they stand: three to one.
TEST(LogProbability, OfAPolicyWithoutANetworkIsTheSoftmaxOfItsPreferences) {
  policy::FrozenPolicy policy;
  for (const policy::ObservationElement& element :
       std::array<policy::ObservationElement, 3>{{{.feature = policy::Feature::kPreference, .age = 1},
                                                  {.feature = policy::Feature::kSpread},
                                                  {.feature = policy::Feature::kPreference}}})
    ASSERT_EQ(policy.observation.spec.push_back(element), Status::kOk);
  for (const UnitNorthEast& direction : {UnitNorthEast{1, 0}, UnitNorthEast{-1, 0}})
    ASSERT_EQ(policy.actions.push_back(direction), Status::kOk);
  const std::array observation{0.0, 0.7, 1.0986122886681098};
  const LogProbability first = log_probability(policy, observation, 0);
  EXPECT_NEAR(first.value, -0.28768207245178096, 1e-15);  // log 3/4
  EXPECT_NEAR(first.gradient[2], 0.25, 1e-15);
  EXPECT_EQ(first.gradient[1], 0.0) << "it does not go by the spread";
  EXPECT_NEAR(first.gradient[0], -0.25, 1e-15);
  EXPECT_NEAR(log_probability(policy, observation, 1).value, -1.3862943611198906, 1e-15);  // log 1/4
}

TEST(LogProbability, OfAPolicyWithANetworkIsItsNetworks) {
  policy::FrozenPolicy policy;
  policy.network = *tests::hand_computed_network();
  EXPECT_EQ(log_probability(policy, std::array{0.5, -0.25}, 0).value, log_probability(policy.network, std::array{0.5, -0.25}, 0).value);
}

}  // namespace
}  // namespace earshot::explain
