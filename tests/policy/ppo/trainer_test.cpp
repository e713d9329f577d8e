#include "policy/ppo/trainer.hpp"
#include "sim/search/reward/step_reward.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace earshot::ppo {
namespace {

class TrainerTest : public testing::Test {
 protected:
  TrainerTest() {
    hyper.environment_count = 3;
    hyper.steps_per_rollout = 200;
  }

  std::vector<float> trained(std::uint64_t seed) {
    const search::World world(settings, curve);
    Trainer trainer(world, simple, hyper, seed);
    trainer.train(1'000, [this](const search::EpisodeRecord& episode, std::uint64_t) {
      episodes.push_back(episode);
      return true;
    });
    steps = trainer.steps();
    return {trainer.networks().parameters().begin(), trainer.networks().parameters().end()};
  }

  sonar::SnrCurve curve{Meters{1'000.0}, std::vector<float>{30.0F, 25.0F, 20.0F, 15.0F, 10.0F, 5.0F, 0.0F}};
  search::SearchSettings settings;
  policy::ObservationModel simple{.spec = policy::simple_state({Meters{25'000.0}, Meters{25'000.0}}), .belief = {}};
  HyperParameters hyper;
  std::vector<search::EpisodeRecord> episodes;
  std::uint64_t steps = 0;
};

TEST_F(TrainerTest, MakesTheSamePolicyFromTheSameSeedAndAnotherFromAnother) {
  EXPECT_EQ(trained(1), trained(1));
  EXPECT_NE(trained(1), trained(2));
}

TEST_F(TrainerTest, RoundsUpToWholeRollouts) {
  trained(1);
  EXPECT_EQ(steps, 1'200U);
}

TEST_F(TrainerTest, TellsOfEveryFinishedEpisodeOnce) {
  trained(1);
  std::uint64_t told = 0;
  for (const search::EpisodeRecord& episode : episodes) {
    EXPECT_NE(episode.end, search::EpisodeEnd::kRunning);
    told += episode.steps;
  }
  EXPECT_LE(told, steps);
  EXPECT_GE(told + 3 * settings.max_steps, steps) << "only the three episodes under way may be untold";
}

TEST_F(TrainerTest, StopsWithTheRolloutInWhichItIsTold) {
  const search::World world(settings, curve);
  Trainer trainer(world, simple, hyper, 1);
  int told = 0;
  trainer.train(1'000'000, [&told](const search::EpisodeRecord&, std::uint64_t) { return ++told != 2; });
  EXPECT_GE(told, 2);
  EXPECT_EQ(trainer.steps(), 600U);
}

bool ignore(const search::EpisodeRecord&, std::uint64_t) {
  return true;
}

TEST_F(TrainerTest, GoesOnFromItsStateAsIfNothingHadHappened) {
  hyper.decay_steps = 3'000;
  const search::World world(settings, curve);
  const policy::ObservationModel model{.spec = policy::memory_state(2, Meters{1'000.0}, Decibels{10.0}).value(), .belief = {}};
  Trainer uninterrupted(world, model, hyper, 5);
  uninterrupted.train(1'200, ignore);
  const TrainingState state = uninterrupted.state();
  const std::vector<float> parameters(uninterrupted.networks().parameters().begin(), uninterrupted.networks().parameters().end());
  const UpdateReport expected = uninterrupted.advance(ignore);

  Trainer resumed(world, model, hyper, 5);
  ASSERT_TRUE(resumed.resume(parameters, state));
  EXPECT_EQ(resumed.steps(), 1'200U);
  const UpdateReport report = resumed.advance(ignore);
  EXPECT_TRUE(std::ranges::equal(resumed.networks().parameters(), uninterrupted.networks().parameters()));
  EXPECT_EQ(report.policy_loss, expected.policy_loss);
  EXPECT_EQ(report.learning_rate, expected.learning_rate);
  EXPECT_EQ(resumed.state().workers[0].episodes, uninterrupted.state().workers[0].episodes);
  EXPECT_EQ(resumed.state().optimiser.second_moment, uninterrupted.state().optimiser.second_moment);
}

TEST_F(TrainerTest, RefusesTheStateOfAnotherTraining) {
  const search::World world(settings, curve);
  const Trainer other(world, simple, hyper, 5);
  const std::span<const float> parameters = other.networks().parameters();
  auto refuses = [&](const TrainingState& state, std::span<const float> p) { return !Trainer(world, simple, hyper, 5).resume(p, state); };
  EXPECT_FALSE(refuses(other.state(), parameters));
  EXPECT_TRUE(refuses(other.state(), parameters.first(7)));
  TrainingState state = other.state();
  state.seed = 6;
  EXPECT_TRUE(refuses(state, parameters));
  state = other.state();
  state.optimiser.first_moment.pop_back();
  EXPECT_TRUE(refuses(state, parameters));
  state = other.state();
  state.workers.push_back(state.workers.front());
  EXPECT_TRUE(refuses(state, parameters)) << "of two ranks";
  state = other.state();
  state.workers[0].episodes.pop_back();
  EXPECT_TRUE(refuses(state, parameters)) << "of two environments";
  state = other.state();
  state.workers[0].episodes[1].actions = {8};
  EXPECT_TRUE(refuses(state, parameters)) << "a ninth direction";
  state.workers[0].episodes[1].actions.assign(101, 0);
  EXPECT_TRUE(refuses(state, parameters)) << "an episode that has ended";
}

TEST_F(TrainerTest, LowersTheLearningRateWithTheStepsTaken) {
  hyper.decay_steps = 2'400;
  const search::World world(settings, curve);
  Trainer trainer(world, simple, hyper, 1);
  EXPECT_DOUBLE_EQ(trainer.advance(ignore).learning_rate, 3e-4 * 0.75);  // 600 of 2400 steps, as Stable-Baselines3 counts
  EXPECT_DOUBLE_EQ(trainer.advance(ignore).learning_rate, 3e-4 * 0.5);
}

TEST_F(TrainerTest, EndsAnUpdateEarlyWhereThePolicyHasMovedFarEnough) {
  const search::World world(settings, curve);
  EXPECT_EQ(Trainer(world, simple, hyper, 1).advance(ignore).minibatches, 100U);  // 10 epochs of 600 samples by 64
  hyper.target_kl = 1e-9;
  const std::size_t minibatches = Trainer(world, simple, hyper, 1).advance(ignore).minibatches;
  EXPECT_GT(minibatches, 1U) << "the first sees the policy unchanged";
  EXPECT_LT(minibatches, 100U);
}

TEST_F(TrainerTest, AddsTheDiscountedValueOfTheLastObservationWhereTheTimeLimitCutAnEpisode) {
  // Every episode is one step long, in mid-domain, out of earshot and out of reach: each reward is -1 and then cut.
  settings.max_steps = 1;
  settings.source = {Meters{1'000.0}, Meters{1'000.0}};
  settings.start_region = {{Meters{10'000.0}, Meters{10'000.0}}, {Meters{20'000.0}, Meters{20'000.0}}};
  hyper.environment_count = 1;
  const search::World world(settings, curve);
  const Trainer untrained(world, simple, hyper, 1);  // values are those before the update
  Trainer trainer(world, simple, hyper, 1);
  trainer.train(1, ignore);

  const Rollout& rollout = trainer.rollout();
  Activations<float> activations({2, 8}, 1);
  for (std::size_t t = 0; t < rollout.size(); ++t) {
    const UnitNorthEast direction = world.actions[rollout.actions[t]];
    const float step = 1.0F / 12.5F;  // 1 km of a state that spans -1 to 1 over 25 km
    const Eigen::Vector2f moved(static_cast<float>(direction.east) * step, static_cast<float>(direction.north) * step);
    const Eigen::Vector2f last = rollout.observations.col(static_cast<Eigen::Index>(t)) + moved;
    untrained.networks().forward(last.data(), 1, activations);
    ASSERT_NEAR(rollout.rewards[t], -1.0F + 0.99F * activations.values(0, 0), 1e-5F);  // rounding of the last observation, times 64 weights
  }
}

TEST_F(TrainerTest, TellsLearningTheRewardsOfTheRunFileBesideThePapers) {
  // Near the source and near an edge: many searches find, many go deep into the border.
  settings.max_steps = 100'000;
  settings.source = {Meters{3'500.0}, Meters{3'500.0}};
  settings.start_region = {{Meters{1'000.0}, Meters{1'000.0}}, {Meters{2'000.0}, Meters{2'000.0}}};
  hyper.reward.found = 10.0;
  hyper.reward.step = -0.25;
  hyper.reward.least = -7.0;
  hyper.reward.scale = 0.5;
  const search::World world(settings, curve);
  Trainer trainer(world, simple, hyper, 1);
  trainer.train(1, ignore);

  const Rollout& rollout = trainer.rollout();
  int found = 0;
  int held = 0;
  for (std::size_t t = 0; t < rollout.size(); ++t) {
    const Eigen::Vector2f state = rollout.observations.col(static_cast<Eigen::Index>(t));
    const NorthEast place{Meters{12'500.0 * (1.0 + double{state.y()})}, Meters{12'500.0 * (1.0 + double{state.x()})}};
    const NorthEast end = place + Meters{1'000.0} * world.actions[rollout.actions[t]];
    const Meters range = range_between(end, settings.source);
    const double paid = search::step_reward(settings, end, curve.at(range));
    held += paid < -7.0 ? 1 : 0;
    found += range <= Meters{1'000.0} ? 1 : 0;
    const double told = 0.5 * (std::max(paid, -7.0) - 0.25 + (range <= Meters{1'000.0} ? 10.0 : 0.0));
    ASSERT_NEAR(double{rollout.rewards[t]}, told, 1e-3) << t;  // places are floats, of 1 mm: a ten-thousandth in the border, times 0.5
  }
  EXPECT_GT(found, 10);
  EXPECT_GT(held, 10);
}

TEST_F(TrainerTest, LearnsToStayClearOfAnEdgeThatCosts) {
  settings.max_steps = 20;
  hyper.steps_per_rollout = 2'048;
  hyper.environment_count = 1;
  const search::World world(settings, curve);
  Trainer trainer(world, simple, hyper, 1);
  std::vector<bool> left;
  trainer.train(40'000, [&left](const search::EpisodeRecord& episode, std::uint64_t) {
    left.push_back(episode.end == search::EpisodeEnd::kLeftDomain);
    return true;
  });
  const auto quarter = static_cast<std::ptrdiff_t>(left.size() / 4);
  EXPECT_LT(2 * std::count(left.end() - quarter, left.end(), true), std::count(left.begin(), left.begin() + quarter, true));
}

}  // namespace
}  // namespace earshot::ppo
