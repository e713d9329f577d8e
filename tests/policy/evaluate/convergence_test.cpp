#include <gtest/gtest.h>

#include <deque>
#include <limits>
#include <memory>

#include "policy/evaluate/evaluation.hpp"
#include "policy/freeze/freeze.hpp"
#include "policy/ppo/trainer.hpp"
#include "policy/ppo/training_run.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::evaluate {
namespace {

class FixedSource : public testing::TestWithParam<std::uint64_t> {};

TEST_P(FixedSource, IsFoundInNinetyNinePercentOfSearchesAfterFifteenHundredEpisodesOfTraining) {
  const ocean::Environment environment = ocean::load_environment(EARSHOT_SOURCE_DIR "/sim/ocean/environments/munk_flat.toml");
  const sonar::SnrCurve curve = sonar::compute_snr_curve(environment, Meters{300.0}, Meters{37'000.0});
  const ppo::TrainingRun paper;
  const search::World world(paper.search, curve);
  const policy::ObservationModel model = ppo::observation_of(paper);

  const auto no_oceans = std::make_unique<policy::OceanTables>();  // a policy that sees no belief needs none
  ppo::Trainer trainer(world, model, *no_oceans, paper.hyper, GetParam());
  std::vector<search::EpisodeRecord> training;
  trainer.train(std::numeric_limits<std::uint64_t>::max(), [&](const search::EpisodeRecord& episode, std::uint64_t) {
    training.push_back(episode);
    return training.size() < 1'500;
  });
  EXPECT_GE(summarise(std::span(training).last(50)).median_reward, -3.0);

  const std::span<const float> parameters = trainer.networks().parameters();
  const ppo::Checkpoint checkpoint{description::describe(paper.search, model), {parameters.begin(), parameters.end()}};
  const auto policy = freeze::freeze(checkpoint, policy::ActionDraw::kSampled);
  const Summary summary = summarise(evaluate(*policy, *no_oceans, policy->draw, world_of(*policy, paper.search, curve), 300, 77));
  EXPECT_GE(summary.found_fraction, 0.99);
  EXPECT_GE(summary.median_reward, -3.0);
}

INSTANTIATE_TEST_SUITE_P(EverySeed, FixedSource, testing::Range<std::uint64_t>(1, 6));

}  // namespace
}  // namespace earshot::evaluate
