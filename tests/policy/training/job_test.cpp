#include "policy/training/job.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::training {
namespace {

std::vector<TrainingJob> jobs(const std::vector<std::string>& arguments) {
  return jobs_of(options_from(arguments), arguments);
}

std::string refusal(const std::vector<std::string>& arguments) {
  try {
    (void)jobs(arguments);
  } catch (const host::BadInput& bad) {
    return bad.what();
  }
  return "not refused";
}

TEST(TrainingJob, KeepsItsCommandLineAndPutsItsCurvesBesideItsCheckpoint) {
  const std::vector<TrainingJob> made = jobs({"run.toml", "-o", "x/a.checkpoint"});
  ASSERT_EQ(made.size(), 1U);
  EXPECT_EQ(made[0].output, "x/a.checkpoint");
  EXPECT_EQ(made[0].curve, "x/a.csv");
  EXPECT_EQ(made[0].updates, "x/a.updates.csv");
  EXPECT_EQ(made[0].arguments, (std::vector<std::string>{"run.toml", "-o", "x/a.checkpoint"}));
  EXPECT_EQ(made[0].directory, std::filesystem::current_path());
  EXPECT_FALSE(made[0].resumed);
}

TEST(TrainingJob, OfEverySeedHasTheSeedInTheNamesOfItsFiles) {
  const std::vector<TrainingJob> made = jobs({"run.toml", "-o", "a.checkpoint", "--curve", "c.csv", "--seeds", "4,2"});
  ASSERT_EQ(made.size(), 2U);
  EXPECT_EQ(made[0].options.seed, 2U);
  EXPECT_EQ(made[0].output, "a.seed2.checkpoint");
  EXPECT_EQ(made[1].options.seed, 4U);
  EXPECT_EQ(made[1].curve, "c.seed4.csv");
  EXPECT_EQ(made[1].updates, "c.seed4.updates.csv");
}

TEST(TrainingJob, IsRefusedWhereOneOfItsFilesWouldReplaceAnother) {
  EXPECT_EQ(refusal({"run.toml"}), "--output: no checkpoint to write given");
  EXPECT_TRUE(support::tells(refusal({"run.toml", "-o", "a.csv"}), {"--output", "a.csv", "--output", "a.csv", "same"}));
  EXPECT_TRUE(support::tells(refusal({"run.toml", "-o", "a.updates.csv", "--curve", "a.csv"}),
                             {"--output", "a.updates.csv", "--curve", "a.updates.csv", "same"}));
  EXPECT_TRUE(support::tells(refusal({"run.toml", "-o", "a.svg", "--plot", "./a.svg"}), {"--output", "a.svg", "--plot", "/a.svg", "same"}));
}

TEST(TrainingJob, OfSeveralCheckpointsTakesNoOutputForOne) {
  EXPECT_TRUE(support::tells(refusal({"--resume", "a.checkpoint", "b.checkpoint", "-o", "c.checkpoint"}), {"--output", "--curve", "not"}));
}

/// A checkpoint of the second of two trainings, that of seed 8; its folder also holds the run.
class ResumedJob : public testing::Test {
 protected:
  ResumedJob() {
    ppo::Checkpoint checkpoint;
    checkpoint.observation.spec = policy::simple_state({Meters{25'000.0}, Meters{25'000.0}});
    checkpoint.direction_count = 8;
    checkpoint.step_length = Meters{1'000.0};
    checkpoint.area_size = {Meters{25'000.0}, Meters{25'000.0}};
    checkpoint.detection_threshold = Decibels{10.0};
    ppo::ActorCritic<float> networks(checkpoint.shape());
    checkpoint.parameters.assign(networks.parameters().begin(), networks.parameters().end());
    checkpoint.continuation = ppo::Continuation{};
    checkpoint.continuation->state.seed = 8;
    checkpoint.continuation->arguments = {"run.toml", "-o", "a.checkpoint", "--seeds", "7,8", "--steps", "4096", "--force"};
    checkpoint.continuation->directory = folder_.path().string();
    checkpoint.continuation->curve = "curves/c.csv";
    std::ofstream(file_) << ppo::to_text(checkpoint);
  }
  [[nodiscard]] TrainingJob resumed(std::vector<std::string> more) const {
    more.insert(more.begin(), {"--resume", file_});
    return jobs(more).at(0);
  }

  const support::TemporaryFolder folder_;
  const std::string file_ = (folder_ / "a.seed8.checkpoint").string();
};

TEST_F(ResumedJob, GoesOnWithItsOwnSeedAndItsOwnFilesAsLongAsItWasToGo) {
  const TrainingJob job = resumed({});
  EXPECT_EQ(job.options.seed, 8U);
  EXPECT_EQ(job.options.steps, 4'096U);
  EXPECT_EQ(job.options.run_file, (folder_ / "run.toml").string());
  EXPECT_EQ(job.output, file_);
  EXPECT_EQ(job.curve, folder_ / "curves/c.csv");
  EXPECT_FALSE(job.options.force) << "that was said of the first time";
}

TEST_F(ResumedJob, ForgetsInWhatItsLengthWasSaidWhenAnotherIsGiven) {
  const TrainingJob job = resumed({"--episodes", "20"});
  EXPECT_EQ(job.options.episodes, 20U);
  EXPECT_FALSE(job.options.steps);
}

}  // namespace
}  // namespace earshot::training
