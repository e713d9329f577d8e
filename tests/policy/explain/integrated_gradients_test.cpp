#include "policy/explain/integrated_gradients.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "policy/explain/network_gradient.hpp"
#include "tests/policy/explain/random_network.hpp"
#include "tests/support/layer_weights.hpp"

namespace earshot::explain {
namespace {

/// A policy of that network; what its elements show does not matter.
std::unique_ptr<policy::FrozenPolicy> with(const policy::Network& network) {
  auto policy = std::make_unique<policy::FrozenPolicy>();
  policy->network = network;
  for (std::size_t i = 0; i < network.observation_size; ++i) (void)policy->observation.spec.push_back({});
  return policy;
}

/// All that a network with one unit in its first layer knows of its inputs is u = w x: by the chain rule the gradient is w everywhere but
/// for one factor, so that the difference is shared out as w_i (x_i - x'_i), whatever comes after u.
TEST(IntegratedGradients, AreThoseOfAHandComputedNetwork) {
  Pcg32 random(5);
  const auto network = random_network({3, {1, 4}, 3}, 2.0F, random);
  tests::set_weights(network->layer(0), 3, {2.0F, -1.0F, 0.0F});
  const std::array x{0.75, 0.25, 0.9};
  const std::array baseline{0.25, 0.75, -0.5};
  // w (x - x') = 2 * 0.5, -1 * -0.5, 0: two thirds, one third, nothing.
  const Attribution a = integrated_gradients(*with(*network), {.observation = x, .baseline = baseline}, 1, 1e-7);
  ASSERT_TRUE(a.is_complete());
  EXPECT_GT(std::abs(a.difference()), 0.01) << "a network that does not care shows nothing";
  EXPECT_NEAR(a.parts[0], a.difference() * 2.0 / 3.0, 1e-7);  // the integral is as good as that
  EXPECT_NEAR(a.parts[1], a.difference() / 3.0, 1e-7);
  EXPECT_EQ(a.parts[2], 0.0);
}

TEST(IntegratedGradients, AddUpToTheDifferenceForEveryNetworkAndEveryPairOfObservations) {
  Pcg32 random(6);
  for (int round = 0; round < 100; ++round) {
    const NetworkSizes sizes{1 + random.next() % 20, {1 + random.next() % 16, 1 + random.next() % 16}, 2 + random.next() % 7};
    const auto network = random_network(sizes, 1.5F, random);
    const std::vector<double> x = random_observation(sizes.observation, random);
    const std::vector<double> baseline = random_observation(sizes.observation, random);
    const std::size_t action = random.next() % sizes.actions;
    const Attribution a = integrated_gradients(*with(*network), {.observation = x, .baseline = baseline}, action);
    EXPECT_TRUE(a.is_complete()) << "round " << round << ": " << a.sum() << " of " << a.difference() << " after " << a.steps;
    EXPECT_EQ(a.difference(), log_probability(*network, x, action).value - log_probability(*network, baseline, action).value);
  }
}

TEST(IntegratedGradients, TakeMoreStepsForATighterTolerance) {
  Pcg32 random(7);
  const auto network = random_network({6, {12, 12}, 4}, 1.0F, random);
  const std::vector<double> x = random_observation(6, random);
  const std::vector<double> baseline(6, 0.0);
  const Comparison comparison{.observation = x, .baseline = baseline};
  const Attribution loose = integrated_gradients(*with(*network), comparison, 0, 1e-2);
  const Attribution tight = integrated_gradients(*with(*network), comparison, 0, 1e-7);
  EXPECT_TRUE(loose.is_complete());
  EXPECT_TRUE(tight.is_complete());
  EXPECT_GT(tight.steps, loose.steps);
}

/// Two units go together from one end of their tanh to the other within a hundredth of the way, and count against each other: 32 midpoints
/// miss most of both, and the sum is right all the same, zero.
TEST(IntegratedGradients, TakeMoreStepsUntilEachPartIsRightAndNotOnlyTheirSum) {
  Pcg32 random(9);
  const auto network = random_network({2, {2, 2}, 2}, 0.0F, random);
  tests::set_weights(network->layer(0), 2, {200.0F, 0.0F, 0.0F, 200.0F});
  network->layer(0).bias[0] = -100.0F;
  network->layer(0).bias[1] = -100.0F;
  tests::set_weights(network->layer(1), 2, {1.0F, -1.0F});
  tests::set_weights(network->layer(2), 2, {1.0F});
  const std::array x{1.0, 1.0};
  const std::array baseline{0.0, 0.0};
  const Attribution a = integrated_gradients(*with(*network), {.observation = x, .baseline = baseline}, 0);
  EXPECT_NEAR(a.difference(), 0.0, 1e-12);
  EXPECT_TRUE(a.is_complete());
  // The units move together, so that nothing follows from their difference: F has slope 1/2 there and each unit moves by 2.
  EXPECT_NEAR(a.parts[0], 1.0, 2e-3);
  EXPECT_NEAR(a.parts[1], -1.0, 2e-3);
  EXPECT_GT(a.steps, kFewestSteps);
}

TEST(IntegratedGradients, SayThatTheyAreNotCompleteRatherThanGoOnForEver) {
  Pcg32 random(8);
  const auto network = random_network({3, {4, 4}, 3}, 1.0F, random);
  const std::vector<double> x = random_observation(3, random);
  const std::vector<double> baseline(3, 0.0);
  const Attribution a = integrated_gradients(*with(*network), {.observation = x, .baseline = baseline}, 0, -1.0);  // which nothing keeps
  EXPECT_FALSE(a.is_complete());
  EXPECT_EQ(a.steps, kMostSteps);
}

/// A policy without a network goes by its preferences, of two actions here: F = -log(1 + exp(b - a)), and with u = b - a the mean of its
/// slopes along the way from u' is (S(u) - S(u')) / (u - u'), S(u) = log(1 + exp(u)).
TEST(IntegratedGradients, AreThoseOfTwoPreferencesByHandWhereThereIsNoNetwork) {
  policy::FrozenPolicy policy;
  for (const policy::ObservationElement& element :
       std::array<policy::ObservationElement, 3>{{{.feature = policy::Feature::kPreference, .age = 1},
                                                  {.feature = policy::Feature::kSpread},
                                                  {.feature = policy::Feature::kPreference}}})
    ASSERT_EQ(policy.observation.spec.push_back(element), Status::kOk);
  for (const UnitNorthEast& direction : {UnitNorthEast{1, 0}, UnitNorthEast{-1, 0}})
    ASSERT_EQ(policy.actions.push_back(direction), Status::kOk);
  policy.network.observation_size = 3;
  policy.network.action_count = 2;
  const std::array x{-0.5, 7.0, 1.0};  // of the second action, of the spread, of the first
  const std::array baseline{0.0, 1.0, 0.0};
  const Attribution a = integrated_gradients(policy, {.observation = x, .baseline = baseline}, 0, 1e-7);
  ASSERT_TRUE(a.is_complete());
  // S(-1.5) = 0.20141328, S(0) = 0.69314718: a mean slope of 0.32782260, which the first moves by 1, the second by -0.5.
  EXPECT_NEAR(a.parts[2], 0.32782260, 2e-7);  // digits as printed, and the tolerance
  EXPECT_NEAR(a.parts[0], 0.16391130, 2e-7);
  EXPECT_EQ(a.parts[1], 0.0);
  EXPECT_NEAR(a.difference(), 0.49173390, 1e-8);
}

}  // namespace
}  // namespace earshot::explain
