// Every key of a run file: what it is when nobody writes it, what it may be, and where it goes.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "policy/ppo/training_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::ppo {
namespace {

class RunFile : public testing::Test {
 protected:
  TrainingRun load(const std::string& text) {
    std::ofstream(folder_ / "run.toml") << text;
    return load_run(folder_ / "run.toml");
  }
  bool is_refused(const std::string& text) {
    try {
      (void)load(text);
      return false;
    } catch (const host::BadInput&) {
      return true;
    }
  }

  const support::TemporaryFolder folder_;
};

TEST_F(RunFile, TakesTheLeastAndTheMostOfEveryKeyAndNothingBeyond) {
  struct Limits {
    std::string table, key, below, least, most, above;
  };
  for (const Limits& limits : std::vector<Limits>{{"", "vehicle_depth_m", "0.0", "0.001", "12000.0", "12000.1"},
                                                  {"", "remembered_steps", "0", "1", "21", "22"},
                                                  {"", "seed", "-1", "0", "9223372036854775807", "1.5"},
                                                  {"", "episodes", "-1", "0", "9223372036854775807", "1.5"},
                                                  {"", "steps", "-1", "0", "9223372036854775807", "1.5"},
                                                  {"search", "domain_east_m", "0.0", "24000.0", "1000000.0", "1000001.0"},
                                                  {"search", "domain_north_m", "0.0", "24000.0", "1000000.0", "1000001.0"},
                                                  {"search", "directions", "0", "1", "32", "33"},
                                                  {"search", "step_length_m", "0.0", "0.001", "10000.0", "1000001.0"},
                                                  {"search", "max_steps", "0", "1", "1000000", "1000001"},
                                                  {"search", "detection_threshold_db", "-200.1", "-200.0", "200.0", "200.1"},
                                                  {"search", "border_width_m", "0.0", "0.001", "1000000.0", "1000001.0"},
                                                  {"search", "border_reward", "-1000001.0", "-1000000.0", "1000000.0", "1000001.0"},
                                                  {"search", "start_margin_m", "-0.1", "0.0", "12499.0", "12500.0"},
                                                  {"training_reward", "found", "-1000001.0", "-1000000.0", "1000000.0", "1000001.0"},
                                                  {"training_reward", "step", "-1000001.0", "-1000000.0", "1000000.0", "1000001.0"},
                                                  {"training_reward", "least", "-1000000001.0", "-1000000000.0", "0.0", "0.1"},
                                                  {"ppo", "environments", "0", "1", "2048", "8193"},
                                                  {"ppo", "steps_per_rollout", "1", "64", "4194304", "4194305"},
                                                  {"ppo", "batch_size", "1", "2", "2048", "2049"},
                                                  {"ppo", "epochs", "0", "1", "10000", "10001"},
                                                  {"ppo", "learning_rate", "0.0", "1e-9", "1.0", "1.1"},
                                                  {"ppo", "discount", "-0.1", "0.0", "1.0", "1.1"},
                                                  {"ppo", "gae_lambda", "-0.1", "0.0", "1.0", "1.1"},
                                                  {"ppo", "clip_range", "0.0", "1e-9", "10.0", "10.1"},
                                                  {"ppo", "value_coefficient", "-0.1", "0.0", "1000000.0", "1000001.0"},
                                                  {"ppo", "entropy_coefficient", "-0.1", "0.0", "1000.0", "1000.1"},
                                                  {"ppo", "max_gradient_norm", "0.0", "1e-9", "1e30", "1.1e30"},
                                                  {"ppo", "target_kl", "-0.1", "0.0", "1000.0", "1000.1"},
                                                  {"ppo", "reward_scale", "0.0", "1e-9", "1000000.0", "1000001.0"}}) {
    const auto with = [&](const std::string& value) {
      return (limits.table.empty() ? "" : "[" + limits.table + "]\n") + limits.key + " = " + value + "\n";
    };
    EXPECT_TRUE(is_refused(with(limits.below))) << limits.key;
    EXPECT_FALSE(is_refused(with(limits.least))) << limits.key;
    EXPECT_FALSE(is_refused(with(limits.most))) << limits.key;
    EXPECT_TRUE(is_refused(with(limits.above))) << limits.key;
  }
  EXPECT_FALSE(is_refused("[ppo]\nenvironments = 8192\nsteps_per_rollout = 512\nbatch_size = 262144\n")) << "the largest rollout";
  EXPECT_TRUE(is_refused("[ppo]\nenvironments = 8192\nsteps_per_rollout = 512\nbatch_size = 262145\n"));
  EXPECT_FALSE(is_refused("[ppo]\nsteps_per_rollout = 2\nbatch_size = 2\n")) << "the smallest";
}

using Lines = std::vector<std::pair<std::string, std::string>>;

// Stable-Baselines3's defaults are those of its PPO's documentation; the paper's are in Clark et al. 2022.
TEST_F(RunFile, DescribesARunOfAnEmptyFile) {
  EXPECT_EQ(describe(load("")), (Lines{{"vehicle_depth_m", "300"},
                                       {"state", "simple"},
                                       {"source", "fixed"},
                                       {"start_margin_m", "0"},
                                       {"border_width_m", "1000"},
                                       {"border_reward", "-100"},
                                       {"max_steps", "100"},
                                       {"detection_threshold_db", "10"},
                                       {"seed", "1"},
                                       {"environments", "1"},
                                       {"steps_per_rollout", "2048"},
                                       {"batch_size", "64"},
                                       {"epochs", "10"},
                                       {"learning_rate", "0.0003"},
                                       {"learning_rate_schedule", "constant"},
                                       {"discount", "0.99"},
                                       {"gae_lambda", "0.95"},
                                       {"clip_range", "0.2"},
                                       {"value_coefficient", "0.5"},
                                       {"entropy_coefficient", "0"},
                                       {"max_gradient_norm", "0.5"},
                                       {"target_kl", "0"},
                                       {"found_reward", "0"},
                                       {"step_reward", "0"},
                                       {"reward_scale", "1"}}));
  const TrainingRun run = load("[search]\n[ppo]\n[training_reward]\n");
  EXPECT_EQ(describe(run), describe(load("")));
  EXPECT_EQ(run.search.domain.south_west, (NorthEast{Meters{0.0}, Meters{0.0}}));
  EXPECT_EQ(run.search.domain.north_east, (NorthEast{Meters{25'000.0}, Meters{25'000.0}}));
  EXPECT_EQ(run.search.direction_count, 8U);
  EXPECT_EQ(run.search.step_length, Meters{1'000.0});
  EXPECT_EQ(run.remembered_steps, 2U);
  EXPECT_EQ(run.episodes, 0U);
  EXPECT_EQ(run.steps, 0U);
  EXPECT_EQ(run.hyper.decay_steps, 0U);
  EXPECT_EQ(run.start, Start::kRegion);
  EXPECT_TRUE(run.environment.empty());
}

TEST_F(RunFile, DescribesARunThatChangesEveryKey) {
  const TrainingRun run = load(R"(environment = "sea.toml"
vehicle_depth_m = 200.0
state = "memory"
remembered_steps = 5
seed = 9
episodes = 77
steps = 88
[search]
source = "changing"
start_margin_m = 1500.0
domain_north_m = 12000.0
domain_east_m = 34000.0
directions = 6
step_length_m = 800.0
max_steps = 60
detection_threshold_db = 7.0
border_width_m = 400.0
border_reward = -20.0
[training_reward]
found = 5.0
step = -0.5
least = -30.0
[ppo]
environments = 3
steps_per_rollout = 50
batch_size = 30
epochs = 4
learning_rate = 0.001
discount = 0.9
gae_lambda = 0.8
clip_range = 0.3
value_coefficient = 0.7
entropy_coefficient = 0.01
max_gradient_norm = 2.0
learning_rate_schedule = "linear"
target_kl = 0.05
reward_scale = 0.1
)");
  EXPECT_EQ(describe(run), (Lines{{"vehicle_depth_m", "200"},
                                  {"state", "memory"},
                                  {"remembered_steps", "5"},
                                  {"source", "changing"},
                                  {"start_margin_m", "1500"},
                                  {"border_width_m", "400"},
                                  {"border_reward", "-20"},
                                  {"max_steps", "60"},
                                  {"detection_threshold_db", "7"},
                                  {"seed", "9"},
                                  {"environments", "3"},
                                  {"steps_per_rollout", "50"},
                                  {"batch_size", "30"},
                                  {"epochs", "4"},
                                  {"learning_rate", "0.001"},
                                  {"learning_rate_schedule", "linear"},
                                  {"discount", "0.9"},
                                  {"gae_lambda", "0.8"},
                                  {"clip_range", "0.3"},
                                  {"value_coefficient", "0.7"},
                                  {"entropy_coefficient", "0.01"},
                                  {"max_gradient_norm", "2"},
                                  {"target_kl", "0.05"},
                                  {"found_reward", "5"},
                                  {"step_reward", "-0.5"},
                                  {"least_reward", "-30"},
                                  {"reward_scale", "0.1"}}));
  EXPECT_EQ(run.environment, folder_ / "sea.toml");
  EXPECT_EQ(run.search.domain.north_east, (NorthEast{Meters{12'000.0}, Meters{34'000.0}}));
  EXPECT_EQ(run.search.start_region.north_east, (NorthEast{Meters{10'500.0}, Meters{32'500.0}}));
  EXPECT_EQ(run.search.direction_count, 6U);
  EXPECT_EQ(run.search.step_length, Meters{800.0});
  EXPECT_EQ(run.episodes, 77U);
  EXPECT_EQ(run.steps, 88U);
  EXPECT_EQ(run.start, Start::kRegion);
}

TEST_F(RunFile, SaysWhetherTheStartMovesWithTheBorder) {
  EXPECT_EQ(load("[search]\nstart = \"domain\"\n").start, Start::kRegion);
  EXPECT_EQ(load("[search]\nstart = \"inside_border\"\n").start, Start::kInsideBorder);
}

}  // namespace
}  // namespace earshot::ppo
