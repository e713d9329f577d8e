#include "policy/training/learning_curve.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace earshot::training {
namespace {

search::EpisodeRecord episode(double reward, search::EpisodeEnd end) {
  return {.reward = reward, .steps = 3, .detections = 0, .end = end};
}

TEST(LearningCurve, GoesOnFromItsFilesExactly) {
  LearningCurve written;
  for (int i = 0; i < 60; ++i) written.add(episode(-i / 3.0, i % 4 == 0 ? search::EpisodeEnd::kFound : search::EpisodeEnd::kTimeLimit), 10);
  written.add(ppo::UpdateReport{}, 2'048);
  LearningCurve resumed(written.episodes_csv(), written.updates_csv());
  EXPECT_EQ(resumed.episodes(), 60U);
  EXPECT_EQ(resumed.recent().median_reward, written.recent().median_reward);
  for (LearningCurve* curve : {&written, &resumed}) {
    curve->add(episode(-0.1, search::EpisodeEnd::kFound), 20);
    curve->add(ppo::UpdateReport{}, 4'096);
  }
  EXPECT_EQ(resumed.episodes_csv(), written.episodes_csv());
  EXPECT_EQ(resumed.updates_csv(), written.updates_csv());
}

TEST(LearningCurve, LooksAtTheLastFiftyEpisodesOnly) {
  LearningCurve curve;
  for (int i = 0; i < 30; ++i) curve.add(episode(-1'000.0, search::EpisodeEnd::kLeftDomain), 1);
  for (int i = 0; i < 50; ++i) curve.add(episode(-i, i < 10 ? search::EpisodeEnd::kFound : search::EpisodeEnd::kTimeLimit), 1);
  EXPECT_EQ(curve.recent().episodes, 50U);
  EXPECT_EQ(curve.recent().median_reward, -24.5);
  EXPECT_EQ(curve.recent().found_fraction, 0.2);
}

TEST(LearningCurve, LeavesEmptyWhatNoEpisodeHasToldYet) {
  LearningCurve curve;
  curve.add(ppo::UpdateReport{.minibatches = 7}, 64);
  const std::string& csv = curve.updates_csv();
  EXPECT_EQ(csv.substr(csv.find('\n') + 1), "64,0,,,0,0,0,0,0,0,0,0,7\n");
  EXPECT_EQ(LearningCurve(curve.episodes_csv(), csv).updates_csv(), csv);
}

TEST(LearningCurve, OfSeveralTrainingsCountsThoseInWhichAnEpisodeHasEnded) {
  using Recent = LearningCurve::Recent;
  const std::vector<Recent> trainings{{50, -2.0, 0.5}, {}, {10, -4.0, 1.0}};
  const Recent all = LearningCurve::recent_of_all(trainings);
  EXPECT_EQ(all.median_reward, -3.0);
  EXPECT_EQ(all.found_fraction, 0.75);
  EXPECT_EQ(to_string(all), "median reward -3.0, found 75 %");
  EXPECT_EQ(to_string(LearningCurve::recent_of_all(std::vector<Recent>(2))), "median reward -, found - %");
}

TEST(LearningCurve, RefusesFilesThatAreNotItsLike) {
  const LearningCurve curve;
  EXPECT_THROW(LearningCurve("episode,steps\n", curve.updates_csv()), std::invalid_argument);
  EXPECT_THROW(LearningCurve(curve.episodes_csv() + "1,2,x,1\n", curve.updates_csv()), std::invalid_argument);
  EXPECT_THROW(LearningCurve(curve.episodes_csv() + "1,2,3", curve.updates_csv()), std::invalid_argument);
}

}  // namespace
}  // namespace earshot::training
