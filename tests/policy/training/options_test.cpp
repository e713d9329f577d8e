#include "policy/training/options.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::training {
namespace {

std::string complaint_of(const auto& action) {
  try {
    action();
  } catch (const host::BadInput& e) {
    return e.what();
  }
  return "";
}

TEST(TrainOptions, TrainFifteenHundredEpisodesWhereNothingSaysHowLong) {
  EXPECT_EQ(settled({}).episodes, 1500U);  // Clark et al. 2022: converged after 1500
  TrainOptions options;
  options.steps = 4096;
  const ppo::TrainingRun by_steps = settled(options);
  EXPECT_EQ(by_steps.episodes, 0U);
  EXPECT_EQ(by_steps.steps, 4096U);
}

TEST(TrainOptions, OnTheCommandLineGoBeforeTheRunFile) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "run.toml") << "seed = 5\nepisodes = 70\n";
  TrainOptions options;
  options.run_file = (folder / "run.toml").string();
  EXPECT_EQ(settled(options).seed, 5U);
  EXPECT_EQ(settled(options).episodes, 70U);
  options.seed = 9;
  options.steps = 2048;
  EXPECT_EQ(settled(options).seed, 9U);
  EXPECT_EQ(settled(options).episodes, 0U) << "so long as the command line says, in steps";
}

TEST(TrainOptions, NameOtherWorldsThanTheRunFile) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "run.toml") << "worlds = [\"train\", \"/seas/more/world.toml\"]\n";
  TrainOptions options;
  options.run_file = (folder / "run.toml").string();
  EXPECT_EQ(settled(options).worlds, (std::vector<std::filesystem::path>{folder / "train", "/seas/more/world.toml"}));
  options.worlds = {"others"};
  EXPECT_EQ(settled(options).worlds, (std::vector<std::filesystem::path>{"others"}));
}

TEST(TrainOptions, TakeWorldsOneByOneAndSeveralAtOnce) {
  const TrainOptions options = options_from({"run.toml", "--world", "a", "--world", "b.toml", "c", "--seed", "2"});
  EXPECT_EQ(options.worlds, (std::vector<std::string>{"a", "b.toml", "c"}));
  EXPECT_EQ(options.run_file, "run.toml");
}

TEST(TrainOptions, RefuseMoreRememberedStepsThanTheStateHas) {
  TrainOptions options;
  options.remembered_steps = 21;
  options.state = "memory";  // 21 steps of 3 numbers fit in an observation of 64
  EXPECT_EQ(complaint_of([&] { (void)settled(options); }), "");
  options.state = "position_memory";  // and beside a position 20
  EXPECT_TRUE(support::tells(complaint_of([&] { (void)settled(options); }),
                             {"--remembered-steps", "remembered_steps", "at most 20", "position_memory"}));
}

TEST(TrainOptions, MakeThePathsOfACommandThatWasGivenElsewhereAbsolute) {
  TrainOptions options;
  options.run_file = "run.toml";
  options.world.environment = "/seas/deep.toml";
  options.worlds = {"train", "/seas/worlds"};
  options.resolve("/home/whale");
  EXPECT_EQ(options.run_file, "/home/whale/run.toml");
  EXPECT_EQ(options.world.environment, "/seas/deep.toml");
  EXPECT_EQ(options.worlds, (std::vector<std::string>{"/home/whale/train", "/seas/worlds"}));
}

TEST(TrainOptions, OfAResumedTrainingChangeItsLengthAndFilesAlone) {
  const auto complaint_about = [](const std::vector<std::string>& arguments) {
    return complaint_of([&] {
      TrainOptions options;
      program::CommandLine line("earshot train", "");
      options.add_to(line);
      (void)line.read(arguments);
      check_for_resume(line);
    });
  };
  EXPECT_EQ(complaint_about({"--resume", "a.checkpoint", "--episodes", "20", "--curve", "a.csv", "--force"}), "");
  EXPECT_TRUE(support::tells(complaint_about({"--resume", "a.checkpoint", "--seed", "2"}), {"--seed", "--resume"}));
  EXPECT_TRUE(support::tells(complaint_about({"--resume", "a.checkpoint", "--world", "train"}), {"--world", "--resume"}));
}

}  // namespace
}  // namespace earshot::training
