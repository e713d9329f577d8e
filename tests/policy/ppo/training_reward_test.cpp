#include "policy/ppo/training_reward.hpp"

#include <gtest/gtest.h>

namespace earshot::ppo {
namespace {

using search::EpisodeEnd;

TEST(TrainingReward, IsTheSearchesOwnWhereARunFileAsksForNothing) {
  EXPECT_EQ(TrainingReward{}.of(-37.5F, EpisodeEnd::kRunning), -37.5F);
  EXPECT_EQ(TrainingReward{}.of(0.0F, EpisodeEnd::kFound), 0.0F);
}

TEST(TrainingReward, AddsItsTermsBeforeItScalesThem) {
  const TrainingReward reward{.found = 10.0, .step = -0.25, .least = -7.0, .scale = 0.5};
  EXPECT_EQ(reward.of(-1.0F, EpisodeEnd::kRunning), -0.625F);   // (-1 - 0.25) / 2
  EXPECT_EQ(reward.of(-1.0F, EpisodeEnd::kFound), 4.375F);      // (-1 - 0.25 + 10) / 2
  EXPECT_EQ(reward.of(-90.0F, EpisodeEnd::kRunning), -3.625F);  // (-7 - 0.25) / 2
  EXPECT_EQ(reward.of(-90.0F, EpisodeEnd::kLeftDomain), -3.625F);
}

TEST(TrainingReward, SaysItsTermsInTheOrderOfProvenanceAndTheLeastOnlyWhereThereIsOne) {
  using Terms = std::vector<std::pair<std::string_view, double>>;
  EXPECT_EQ(describe(TrainingReward{}), (Terms{{"found_reward", 0.0}, {"step_reward", 0.0}, {"reward_scale", 1.0}}));
  EXPECT_EQ(describe(TrainingReward{.least = -7.0}),
            (Terms{{"found_reward", 0.0}, {"step_reward", 0.0}, {"least_reward", -7.0}, {"reward_scale", 1.0}}));
}

}  // namespace
}  // namespace earshot::ppo
