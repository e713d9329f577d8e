#include "policy/ppo/trainer.hpp"

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
    const search::SearchWorld world(settings, curve);
    Trainer trainer(world, {.spec = policy::simple_state({Meters{25'000.0}, Meters{25'000.0}}), .belief = {}}, hyper, seed);
    trainer.train(1'000, [this](const search::EpisodeRecord& episode, std::uint64_t) {
      episodes.push_back(episode);
      return true;
    });
    steps = trainer.steps();
    return {trainer.networks().parameters().begin(), trainer.networks().parameters().end()};
  }

  sonar::SnrCurve curve{Meters{1'000.0}, std::vector<float>{30.0F, 25.0F, 20.0F, 15.0F, 10.0F, 5.0F, 0.0F}};
  search::SearchSettings settings;
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

TEST_F(TrainerTest, StopsAtOnceWhenTold) {
  const search::SearchWorld world(settings, curve);
  Trainer trainer(world, {.spec = policy::simple_state({Meters{25'000.0}, Meters{25'000.0}}), .belief = {}}, hyper, 1);
  int told = 0;
  trainer.train(1'000'000, [&told](const search::EpisodeRecord&, std::uint64_t) { return ++told < 2; });
  EXPECT_EQ(told, 2);
}

TEST_F(TrainerTest, AddsTheDiscountedValueOfTheLastObservationWhereTheTimeLimitCutAnEpisode) {
  // Every episode is one step long, in mid-domain, out of earshot and out of reach: each reward is -1 and then cut.
  settings.max_steps = 1;
  settings.source = {Meters{1'000.0}, Meters{1'000.0}};
  settings.start_region = {{Meters{10'000.0}, Meters{10'000.0}}, {Meters{20'000.0}, Meters{20'000.0}}};
  hyper.environment_count = 1;
  const search::SearchWorld world(settings, curve);
  Trainer trainer(world, {.spec = policy::simple_state({Meters{25'000.0}, Meters{25'000.0}}), .belief = {}}, hyper, 1);
  std::size_t told = 0;
  trainer.train(1'000,
                [&](const search::EpisodeRecord&, std::uint64_t) { return ++told < hyper.steps_per_rollout; });  // a rollout, no update

  const Rollout& rollout = trainer.rollout();
  Activations<float> activations({2, 8}, 1);
  for (std::size_t t = 0; t < rollout.size(); ++t) {
    const UnitNorthEast direction = world.actions[rollout.actions[t]];
    const float step = 1.0F / 12.5F;  // 1 km of a state that spans -1 to 1 over 25 km
    const Eigen::Vector2f moved(static_cast<float>(direction.east) * step, static_cast<float>(direction.north) * step);
    const Eigen::Vector2f last = rollout.observations.col(static_cast<Eigen::Index>(t)) + moved;
    trainer.networks().forward(last.data(), 1, activations);
    ASSERT_NEAR(rollout.rewards[t], -1.0F + 0.99F * activations.values(0, 0), 1e-5F);  // rounding of the last observation, times 64 weights
  }
}

TEST_F(TrainerTest, LearnsToStayClearOfAnEdgeThatCosts) {
  settings.max_steps = 20;
  hyper.steps_per_rollout = 2'048;
  hyper.environment_count = 1;
  const search::SearchWorld world(settings, curve);
  Trainer trainer(world, {.spec = policy::simple_state({Meters{25'000.0}, Meters{25'000.0}}), .belief = {}}, hyper, 1);
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
