#include "policy/ppo/trainer.hpp"
#include "sim/search/reward/step_reward.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace earshot::ppo {
namespace {

const policy::OceanTables kNoOceans;  // a policy that sees no belief needs none

class TrainerTest : public testing::Test {
 protected:
  TrainerTest() {
    hyper.environment_count = 3;
    hyper.steps_per_rollout = 200;
  }

  std::vector<float> trained(std::uint64_t seed) {
    const search::World world(settings, curve);
    Trainer trainer(world, simple, kNoOceans, hyper, seed);
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
  Trainer trainer(world, simple, kNoOceans, hyper, 1);
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
  Trainer uninterrupted(world, model, kNoOceans, hyper, 5);
  uninterrupted.train(1'200, ignore);
  const TrainingState state = uninterrupted.state();
  const std::vector<float> parameters(uninterrupted.networks().parameters().begin(), uninterrupted.networks().parameters().end());
  const UpdateReport expected = uninterrupted.advance(ignore);

  Trainer resumed(world, model, kNoOceans, hyper, 5);
  ASSERT_TRUE(resumed.resume(parameters, state));
  EXPECT_EQ(resumed.steps(), 1'200U);
  const UpdateReport report = resumed.advance(ignore);
  EXPECT_TRUE(std::ranges::equal(resumed.networks().parameters(), uninterrupted.networks().parameters()));
  EXPECT_EQ(report.policy_loss, expected.policy_loss);
  EXPECT_EQ(report.learning_rate, expected.learning_rate);
  EXPECT_EQ(resumed.state().workers[0].episodes, uninterrupted.state().workers[0].episodes);
  EXPECT_EQ(resumed.rollout().episode_starts, uninterrupted.rollout().episode_starts) << "the first step is in mid-episode";
  EXPECT_EQ(resumed.state().optimiser.second_moment, uninterrupted.state().optimiser.second_moment);
}

TEST_F(TrainerTest, RefusesTheStateOfAnotherTraining) {
  const search::World world(settings, curve);
  const Trainer other(world, simple, kNoOceans, hyper, 5);
  const std::span<const float> parameters = other.networks().parameters();
  auto refuses = [&](const TrainingState& state, std::span<const float> p) {
    return !Trainer(world, simple, kNoOceans, hyper, 5).resume(p, state);
  };
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
  Trainer trainer(world, simple, kNoOceans, hyper, 1);
  EXPECT_DOUBLE_EQ(trainer.advance(ignore).learning_rate, 3e-4 * 0.75);  // 600 of 2400 steps, as Stable-Baselines3 counts
  EXPECT_DOUBLE_EQ(trainer.advance(ignore).learning_rate, 3e-4 * 0.5);
}

TEST_F(TrainerTest, KeepsTheLearningRateAtZeroOnceItHasFallenThere) {
  hyper.decay_steps = 1'000;
  const search::World world(settings, curve);
  Trainer trainer(world, simple, kNoOceans, hyper, 1);
  EXPECT_DOUBLE_EQ(trainer.advance(ignore).learning_rate, 3e-4 * 0.4);
  EXPECT_EQ(trainer.advance(ignore).learning_rate, 0.0);  // after 1200 steps
}

/// A trainer whose networks see nothing: of every place they say these logits and this value.
void predict_everywhere(Trainer& trainer, const std::vector<float>& logits, float value) {
  std::vector<float> parameters(trainer.networks().parameters().size());
  std::ranges::copy(logits, parameters.begin() + trainer.networks().layout().logits.bias());
  parameters[static_cast<std::size_t>(trainer.networks().layout().value.bias())] = value;
  ASSERT_TRUE(trainer.resume(parameters, trainer.state()));
}

TEST_F(TrainerTest, DrawsActionsAsOftenAsThePolicySaysAndRemembersHowLikelyTheyWere) {
  const std::vector<double> probabilities{0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625, 0.0078125, 0.0078125};
  std::vector<float> logits;
  for (const double p : probabilities) logits.push_back(static_cast<float>(std::log(p)) + 3.0F);  // only differences count
  hyper.steps_per_rollout = 4'000;
  const search::World world(settings, curve);
  Trainer trainer(world, simple, kNoOceans, hyper, 1);
  predict_everywhere(trainer, logits, 0.0F);
  (void)trainer.advance(ignore);
  std::vector<int> drawn(8);
  for (std::size_t i = 0; i < trainer.rollout().size(); ++i) {
    const std::uint8_t action = trainer.rollout().actions[i];
    drawn[action] += 1;
    ASSERT_NEAR(trainer.rollout().log_probabilities[i], std::log(probabilities[action]), 1e-5) << i;  // floats near 5
  }
  for (std::size_t a = 0; a < 8; ++a) {
    const double p = probabilities[a];
    EXPECT_NEAR(drawn[a] / 12'000.0, p, 5.0 * std::sqrt(p * (1.0 - p) / 12'000.0)) << a;  // five standard errors
  }
}

TEST_F(TrainerTest, EstimatesEachEnvironmentsAdvantagesFromItsOwnSteps) {
  hyper.gae_lambda = 0.0;  // of one step: reward, and the value after it where the episode goes on, less the value before
  const search::World world(settings, curve);
  Trainer trainer(world, simple, kNoOceans, hyper, 1);
  predict_everywhere(trainer, std::vector<float>(8), 2.0F);
  (void)trainer.advance(ignore);
  const Rollout& rollout = trainer.rollout();
  const std::vector<search::EpisodeScript> under_way = trainer.state().workers[0].episodes;
  int ended = 0;
  for (std::size_t e = 0; e < 3; ++e) {
    for (std::size_t t = 0; t < 200; ++t) {
      const std::size_t i = e * 200 + t;
      const bool ends = t + 1 < 200 ? rollout.episode_starts[i + 1] != 0 : under_way[e].actions.empty();
      ended += ends ? 1 : 0;
      ASSERT_EQ(rollout.values[i], 2.0F);
      ASSERT_NEAR(rollout.advantages[i], rollout.rewards[i] + (ends ? 0.0F : 0.99F * 2.0F) - 2.0F, 1e-4F)
          << e << ' ' << t;  // floats near 100
      ASSERT_NEAR(rollout.returns[i], rollout.advantages[i] + 2.0F, 1e-4F);
    }
    EXPECT_EQ(rollout.episode_starts[e * 200], 1);
  }
  EXPECT_GT(ended, 5);
}

TEST_F(TrainerTest, SaysHowMuchOfTheReturnsTheValuesExplain) {
  const search::World world(settings, curve);
  Trainer trainer(world, simple, kNoOceans, hyper, 1);
  const UpdateReport report = trainer.advance(ignore);
  const Rollout& rollout = trainer.rollout();
  const auto variance = [&](auto value) {  // E x^2 - (E x)^2
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < rollout.size(); ++i) {
      sum += value(i) / static_cast<double>(rollout.size());
      squares += value(i) * value(i) / static_cast<double>(rollout.size());
    }
    return squares - sum * sum;
  };
  const double unexplained = variance([&](std::size_t i) { return double{rollout.returns[i]} - double{rollout.values[i]}; });
  const double all = variance([&](std::size_t i) { return double{rollout.returns[i]}; });
  EXPECT_NEAR(report.explained_variance, 1.0 - unexplained / all, 1e-9);  // doubles
  EXPECT_NE(report.explained_variance, 0.0);
}

TEST_F(TrainerTest, SaysWithEveryEpisodeHowManyStepsAllHaveTaken) {
  const search::World world(settings, curve);
  Trainer trainer(world, simple, kNoOceans, hyper, 1);
  std::vector<std::uint64_t> at;
  trainer.train(1'200, [&at](const search::EpisodeRecord&, std::uint64_t taken) {
    at.push_back(taken);
    return true;
  });
  ASSERT_FALSE(at.empty());
  EXPECT_TRUE(std::ranges::is_sorted(at));
  EXPECT_GE(at.front(), 3U);
  EXPECT_LE(at.back(), 1'200U);
  EXPECT_TRUE(std::ranges::all_of(at, [](std::uint64_t taken) { return taken % 3 == 0; })) << "three environments step together";
}

/// One of two ranks; the other one gives zeros.
class OneOfTwo : public parallel::Alone {
 public:
  explicit OneOfTwo(std::size_t rank) : rank_(rank) {}
  [[nodiscard]] std::size_t rank() const override { return rank_; }
  [[nodiscard]] std::size_t size() const override { return 2; }
  void gather_everywhere(std::span<const float> mine, std::span<float> all) override {
    std::ranges::fill(all, 0.0F);
    std::ranges::copy(mine, all.subspan(rank_ * mine.size()).begin());
  }

 private:
  std::size_t rank_;
};

TEST_F(TrainerTest, OfTwoRanksLearnsFromTheMeanOfTheirGradientsInEnvironmentsOfItsOwn) {
  const search::World world(settings, curve);
  hyper.epochs = 1;
  hyper.batch_size = 600;  // all that a rank has
  Trainer alone(world, simple, kNoOceans, hyper, 1);
  OneOfTwo first_of_two(0);
  OneOfTwo second_of_two(1);
  Trainer first(world, simple, kNoOceans, hyper, 1, first_of_two);
  Trainer second(world, simple, kNoOceans, hyper, 1, second_of_two);
  EXPECT_TRUE(std::ranges::equal(first.networks().parameters(), second.networks().parameters())) << "they begin as one";
  EXPECT_NE(first.state().workers[0].random.increment, second.state().workers[0].random.increment) << "what they draw is another stream";
  const UpdateReport of_all = alone.advance(ignore);
  const UpdateReport of_half = first.advance(ignore);
  (void)second.advance(ignore);
  EXPECT_EQ(alone.steps(), 600U);
  EXPECT_EQ(first.steps(), 1'200U) << "the steps of both";
  EXPECT_EQ(of_half.value_loss, of_all.value_loss / 2.0);
  EXPECT_EQ(of_half.entropy, of_all.entropy / 2.0);
  EXPECT_NEAR(of_half.gradient_norm, of_all.gradient_norm / 2.0, 1e-6 * of_all.gradient_norm);  // floats
  EXPECT_EQ(first.rollout().actions, alone.rollout().actions) << "the first rank draws as one alone does";
  EXPECT_NE(second.rollout().actions, alone.rollout().actions);
  const auto start_of = [](const Trainer& t, Eigen::Index e) { return Eigen::Vector2f(t.rollout().observations.col(e * 200)); };
  Trainer six(
      world, simple, kNoOceans,
      [this] {
        HyperParameters h = hyper;
        h.environment_count = 6;
        return h;
      }(),
      1);
  (void)six.advance(ignore);
  for (Eigen::Index e = 0; e < 3; ++e) EXPECT_EQ(start_of(second, e), start_of(six, e + 3)) << "the streams after the first rank's";
}

TEST_F(TrainerTest, EndsAnUpdateEarlyWhereThePolicyHasMovedFarEnough) {
  const search::World world(settings, curve);
  EXPECT_EQ(Trainer(world, simple, kNoOceans, hyper, 1).advance(ignore).minibatches, 100U);  // 10 epochs of 600 samples by 64
  hyper.target_kl = 1e-9;
  const std::size_t minibatches = Trainer(world, simple, kNoOceans, hyper, 1).advance(ignore).minibatches;
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
  const Trainer untrained(world, simple, kNoOceans, hyper, 1);  // values are those before the update
  Trainer trainer(world, simple, kNoOceans, hyper, 1);
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
  Trainer trainer(world, simple, kNoOceans, hyper, 1);
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
  Trainer trainer(world, simple, kNoOceans, hyper, 1);
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
