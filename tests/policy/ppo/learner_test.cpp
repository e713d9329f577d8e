#include "policy/ppo/learner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "policy/ppo/advantage.hpp"

namespace earshot::ppo {
namespace {

// The inputs of tests/oracles/ppo/make_update_fixture.py, which had Stable-Baselines3 2.3.2 do the same.
constexpr NetworkShape kNetworks{6, 8};
constexpr std::size_t kEnvironments = 2;
constexpr std::size_t kSteps = 40;
constexpr std::size_t kSamples = kEnvironments * kSteps;
constexpr std::array<std::size_t, 3> kStrides{3, 7, 9};
using Networks = ActorCritic<float>;

float uniform(std::uint32_t stream, std::uint32_t i) {
  std::uint32_t x = i * 2654435761U + stream * 40503U + 12345U;
  x ^= x >> 15U;
  x *= 2246822519U;
  x ^= x >> 13U;
  return static_cast<float>(x >> 16U) / 65536.0F;
}

std::vector<float> inputs(std::uint32_t stream, std::size_t count, float scale, float offset) {
  std::vector<float> all(count);
  for (std::uint32_t i = 0; i < count; ++i) all[i] = scale * uniform(stream, i) + offset;
  return all;
}

Rollout made_up_rollout(std::size_t steps = kSteps) {
  const std::size_t samples = kEnvironments * steps;
  Rollout rollout(kNetworks, kEnvironments, steps);
  const std::vector<float> observations = inputs(1, samples * 6, 2.0F, -1.0F);
  std::ranges::copy(observations, rollout.observations.data());
  const std::vector<float> actions = inputs(2, samples, 8.0F, 0.0F);
  std::ranges::transform(actions, rollout.actions.begin(), [](float x) { return static_cast<std::uint8_t>(x); });
  rollout.log_probabilities = inputs(3, samples, 1.0F, -2.5F);
  rollout.values = inputs(4, samples, 4.0F, -2.0F);
  rollout.rewards = inputs(5, samples, 2.0F, -1.5F);
  const std::vector<float> starts = inputs(6, samples, 1.0F, 0.0F);
  std::ranges::transform(starts, rollout.episode_starts.begin(), [](float x) { return x < 0.1F ? 1 : 0; });
  return rollout;
}

void estimate(Rollout& rollout) {
  constexpr std::array<float, 2> kNextValues{0.5F, -1.25F};
  constexpr std::array<bool, 2> kDones{false, true};
  for (std::size_t e = 0; e < kEnvironments; ++e) {
    auto part = [e](auto& all) { return std::span(all).subspan(e * kSteps, kSteps); };
    estimate_advantages({part(rollout.rewards), part(rollout.values), part(rollout.episode_starts), kNextValues[e], kDones[e]}, 0.99, 0.95,
                        part(rollout.advantages));
  }
  for (std::size_t i = 0; i < kSamples; ++i) rollout.returns[i] = rollout.advantages[i] + rollout.values[i];
}

/// Calls visit(flat index in our array, name, index in PyTorch's row-major tensor) for every parameter.
template <class Visit>
void for_each_parameter(const Networks::Layout& layout, Visit visit) {
  auto dense = [&visit](const Networks::Layer& layer, Eigen::Index row, Eigen::Index rows, const std::string& name) {
    for (Eigen::Index o = 0; o < rows; ++o) {
      for (Eigen::Index i = 0; i < layer.inputs; ++i) {
        visit(static_cast<std::size_t>(layer.offset + i * layer.outputs + row + o), name + ".weight",
              static_cast<std::size_t>(o * layer.inputs + i));
      }
      visit(static_cast<std::size_t>(layer.bias() + row + o), name + ".bias", static_cast<std::size_t>(o));
    }
  };
  dense(layout.first, 0, kWidth, "mlp_extractor.policy_net.0");
  dense(layout.first, kWidth, kWidth, "mlp_extractor.value_net.0");
  dense(layout.actor_second, 0, kWidth, "mlp_extractor.policy_net.2");
  dense(layout.critic_second, 0, kWidth, "mlp_extractor.value_net.2");
  dense(layout.logits, 0, kNetworks.action_count, "action_net");
  dense(layout.value, 0, 1, "value_net");
}

class UpdateTest : public testing::Test {
 protected:
  UpdateTest() : rollout(made_up_rollout()) {
    std::ifstream stream(EARSHOT_SOURCE_DIR "/tests/policy/ppo/update.json");
    expected = nlohmann::json::parse(stream);
    estimate(rollout);
  }
  nlohmann::json expected;
  Rollout rollout;
};

TEST_F(UpdateTest, EstimatesTheAdvantagesOfStableBaselines3) {
  for (std::size_t i = 0; i < kSamples; ++i) {
    ASSERT_NEAR(rollout.advantages[i], expected["advantages"][i].get<float>(), 5e-6F) << i;  // sums of some ten floats of order 5
    ASSERT_NEAR(rollout.returns[i], expected["returns"][i].get<float>(), 5e-6F) << i;
  }
}

TEST_F(UpdateTest, LeavesTheParametersOfStableBaselines3AfterThreeEpochsWithAShortLastBatch) {
  HyperParameters hyper;
  hyper.environment_count = kEnvironments;
  hyper.steps_per_rollout = kSteps;
  hyper.batch_size = 32;
  hyper.entropy_coefficient = 0.01;
  Pcg32 random(1);
  parallel::Alone alone;
  Learner learner(kNetworks, hyper, random, alone);
  const std::span<float> parameters = learner.networks().parameters();
  std::map<std::string, std::uint32_t> stream_of;
  for (const auto& [name, values] : expected["parameters"].items()) stream_of.emplace(name, 100 + stream_of.size());
  std::size_t visited = 0;
  for_each_parameter(learner.networks().layout(), [&](std::size_t flat, const std::string& name, std::size_t i) {
    parameters[flat] = 0.5F * uniform(stream_of.at(name), static_cast<std::uint32_t>(i)) - 0.25F;
    ++visited;
  });
  ASSERT_EQ(visited, parameters.size());

  UpdateReport sums;
  for (std::size_t epoch = 0; epoch < kStrides.size(); ++epoch) {
    std::vector<std::uint32_t> order(kSamples);
    for (std::size_t i = 0; i < kSamples; ++i) order[i] = static_cast<std::uint32_t>((i * kStrides[epoch] + epoch) % kSamples);
    ASSERT_TRUE(learner.run_epoch(rollout, order, hyper.learning_rate, sums));
  }

  // Nine Adam steps of 3e-4 move each parameter by up to 2.7e-3. Rounding: gradients agree to some 1e-7, and Adam divides by
  // sqrt(v) + 1e-5, so that rounding moves a parameter by up to some thousandth of a step.
  for_each_parameter(learner.networks().layout(), [&](std::size_t flat, const std::string& name, std::size_t i) {
    const double difference = std::abs(static_cast<double>(parameters[flat]) - expected["parameters"][name][i].get<double>());
    ASSERT_LT(difference, 3e-7) << name << " " << i;
  });
}

TEST(Learner, GivesTheSameParametersForTheSameSeedWhereverTheHeapPutsThem) {
  Rollout rollout = made_up_rollout();
  estimate(rollout);
  HyperParameters hyper;
  hyper.environment_count = kEnvironments;
  hyper.steps_per_rollout = kSteps;
  auto learned = [&](std::uint64_t seed) {
    Pcg32 random(seed);
    parallel::Alone alone;
    Learner learner(kNetworks, hyper, random, alone);
    (void)learner.update(rollout, hyper.learning_rate, random);
    const auto p = learner.networks().parameters();
    return std::vector<float>(p.begin(), p.end());
  };
  const std::vector<float> first = learned(1);
  std::vector<std::vector<char>> in_the_way;
  for (std::size_t i = 0; i < 20; ++i) {
    in_the_way.emplace_back(5'000 + 16 * i);  // moves what follows by an odd or an even number of half packets
    ASSERT_EQ(learned(1), first);
  }
  EXPECT_NE(learned(2), first);
}

/// A learner of the made-up rollout that stays as it is.
UpdateReport report_of(const HyperParameters& hyper, std::uint64_t seed = 1) {
  Rollout rollout = made_up_rollout();
  estimate(rollout);
  Pcg32 initial(1);
  parallel::Alone alone;
  Learner learner(kNetworks, hyper, initial, alone);
  Pcg32 random(seed);
  return learner.update(rollout, 0.0, random);
}

TEST(Learner, MeansItsFiguresOverAllMinibatches) {
  HyperParameters hyper;
  hyper.environment_count = kEnvironments;
  hyper.steps_per_rollout = kSteps;
  hyper.epochs = 3;
  hyper.batch_size = kSamples;
  const UpdateReport whole = report_of(hyper);
  EXPECT_EQ(whole.minibatches, 3U);
  hyper.batch_size = kSamples / 4;
  const UpdateReport quarters = report_of(hyper);
  EXPECT_EQ(quarters.minibatches, 12U);
  // Means of quarters of one size are that of the whole where no minibatch is normalised by itself; floats of order 1.
  EXPECT_NEAR(quarters.value_loss, whole.value_loss, 1e-5);
  EXPECT_NEAR(quarters.entropy, whole.entropy, 1e-5);
  EXPECT_NEAR(quarters.approximate_kl, whole.approximate_kl, 1e-5);
  EXPECT_NEAR(quarters.clip_fraction, whole.clip_fraction, 1e-5);
  EXPECT_GT(whole.clip_fraction, 0.1);
  EXPECT_GT(whole.approximate_kl, 0.01);
}

TEST(Learner, ShufflesItsSamplesByItsRandomNumbers) {
  HyperParameters hyper;
  hyper.environment_count = kEnvironments;
  hyper.steps_per_rollout = kSteps;
  hyper.epochs = 1;
  hyper.batch_size = kSamples / 4;
  std::vector<double> norms;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) norms.push_back(report_of(hyper, seed).gradient_norm);
  std::ranges::sort(norms);
  EXPECT_EQ(std::ranges::adjacent_find(norms), norms.end()) << "other quarters, other gradients";
}

TEST(Learner, EndsAnUpdateWhereThePolicyHasMovedHalfAsFarAgainAsItMay) {
  HyperParameters hyper;
  hyper.environment_count = kEnvironments;
  hyper.steps_per_rollout = kSteps;
  hyper.epochs = 3;
  hyper.batch_size = kSamples;
  const double moved = report_of(hyper).approximate_kl;
  hyper.target_kl = moved / 1.5 * 1.001;
  EXPECT_EQ(report_of(hyper).minibatches, 3U);
  hyper.target_kl = moved / 1.5 * 0.999;
  EXPECT_EQ(report_of(hyper).minibatches, 1U);
}

TEST(Learner, LearnsFromALargeMinibatchInSlicesAsIfFromAllOfItAtOnce) {
  constexpr std::size_t kLarge = 600;  // more than two slices
  Rollout rollout = made_up_rollout(kLarge / kEnvironments);
  rollout.advantages = rollout.rewards;
  rollout.returns = rollout.values;
  HyperParameters hyper;
  hyper.environment_count = kEnvironments;
  hyper.steps_per_rollout = kLarge / kEnvironments;
  hyper.batch_size = kLarge;
  hyper.entropy_coefficient = 0.01;
  Pcg32 random(3);
  parallel::Alone alone;
  Learner learner(kNetworks, hyper, random, alone);
  Networks at_once = learner.networks();
  std::vector<std::uint32_t> order(kLarge);
  std::iota(order.begin(), order.end(), 0U);
  UpdateReport sums;
  ASSERT_TRUE(learner.run_epoch(rollout, order, hyper.learning_rate, sums));

  Activations<float> activations(kNetworks, kLarge);
  Matrix<float> d_logits(kNetworks.action_count, kLarge);
  Matrix<float> d_values(1, kLarge);
  std::vector<float> gradient(at_once.parameters().size());
  Aligned<float> advantages(rollout.advantages.begin(), rollout.advantages.end());
  normalise(std::span<float>(advantages));
  at_once.forward(rollout.observations.data(), kLarge, activations);
  const Samples<float> samples{rollout.actions, rollout.log_probabilities, advantages, rollout.returns, kLarge};
  const LossTerms<float> loss = ppo_loss(samples, hyper, activations.logits, activations.values, d_logits, d_values);
  at_once.backward(rollout.observations.data(), kLarge, activations, d_logits, d_values, gradient);
  EXPECT_NEAR(sums.policy_loss, double{loss.policy}, 1e-6);
  EXPECT_NEAR(sums.value_loss, double{loss.value}, 1e-6);
  EXPECT_NEAR(sums.entropy, double{loss.entropy}, 6e-5);  // a float's sum of 600 times 2, each rounded by up to 6e-5 of one
  EXPECT_NEAR(sums.gradient_norm, clip_gradient(gradient, hyper.max_gradient_norm), 1e-6);
  Adam adam(gradient.size());
  adam.step(at_once.parameters(), gradient, hyper.learning_rate);
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    // Adam's first step is 3e-4 g / (|g| + 1e-5): an error of 1e-8 in a gradient near zero moves a parameter by 3e-7.
    ASSERT_NEAR(learner.networks().parameters()[i], at_once.parameters()[i], 5e-7F) << i;
  }
}

}  // namespace
}  // namespace earshot::ppo
