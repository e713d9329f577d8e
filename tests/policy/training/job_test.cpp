#include "policy/training/job.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"

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
  EXPECT_EQ(refusal({"run.toml", "-o", "a.csv"}),
            "--output a.csv, the learning curve of --output a.csv: the same file, one would replace the other");
  EXPECT_EQ(refusal({"run.toml", "-o", "a.updates.csv", "--curve", "a.csv"}),
            "--output a.updates.csv, the losses beside --curve a.updates.csv: the same file, one would replace the other");
  EXPECT_EQ(refusal({"run.toml", "-o", "a.svg", "--plot", "./a.svg"}),
            "--output a.svg, --plot ./a.svg: the same file, one would replace the other");
}

TEST(TrainingJob, OfSeveralCheckpointsTakesNoOutputForOne) {
  EXPECT_EQ(refusal({"--resume", "a.checkpoint", "b.checkpoint", "-o", "c.checkpoint"}),
            "--output, --curve: for one training, not for several");
}

}  // namespace
}  // namespace earshot::training
