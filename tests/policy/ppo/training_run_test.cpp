#include "policy/ppo/training_run.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::ppo {
namespace {

std::string written(const std::string& text) {
  static const support::TemporaryFolder folder;
  const std::string path = folder / "run.toml";
  std::ofstream(path) << text;
  return path;
}

/// What is said of a run file that is refused.
std::string complaint_of(const std::string& path) {
  try {
    (void)load_run(path);
  } catch (const host::BadInput& e) {
    return e.what();
  }
  ADD_FAILURE() << path << " was taken";
  return "";
}

TEST(TrainingRun, IsThePapersWithStableBaselines3sDefaultsWhenTheFileIsEmpty) {
  const TrainingRun run = load_run(written(""));
  EXPECT_EQ(run.search.border_reward, -100.0);
  EXPECT_EQ(run.search.max_steps, 100U);
  EXPECT_EQ(run.hyper.steps_per_rollout, 2048U);
  EXPECT_EQ(run.hyper.learning_rate, 3e-4);
}

TEST(TrainingRun, ReadsTheShippedFile) {
  const TrainingRun run = load_run(EARSHOT_SOURCE_DIR "/policy/ppo/runs/fixed_source.toml");
  EXPECT_TRUE(std::filesystem::exists(run.environment));
  EXPECT_EQ(run.episodes, 1'500U);
}

TEST(TrainingRun, LooksForTheFilesThatItNamesBesideItself) {
  const std::string path =
      written("environment = \"sea.toml\"\nworlds = [\"train\", \"/seas/more\"]\ntables = [\"a.tables\", \"/seas/b.tables\"]\n");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const TrainingRun run = load_run(path);
  EXPECT_EQ(run.environment, folder / "sea.toml");
  EXPECT_EQ(run.worlds, (std::vector<std::filesystem::path>{folder / "train", "/seas/more"}));
  EXPECT_EQ(run.tables, (std::vector<std::filesystem::path>{folder / "a.tables", "/seas/b.tables"}));
}

TEST(TrainingRun, SaysHowFarFromTheDomainsEdgeSearchesStartWhereverTheDomainLies) {
  TrainingRun run = load_run(written("[search]\nstart_margin_m = 700.0\n"));
  for (Meters* corner : {&run.search.domain.south_west.north, &run.search.start_region.south_west.north})
    *corner = *corner + Meters{5'000.0};
  const auto lines = describe(run);
  EXPECT_TRUE(std::ranges::find(lines, std::pair<std::string, std::string>("start_margin_m", "700")) != lines.end());
}

TEST(TrainingRun, StartsInsideTheBorderWhenTold) {
  const TrainingRun run = load_run(written("[search]\nstart = \"inside_border\"\nborder_width_m = 2000.0\n"));
  EXPECT_EQ(run.search.start_region.south_west.north, Meters{2'000.0});
  EXPECT_EQ(run.search.start_region.north_east.east, Meters{23'000.0});
}

TEST(TrainingRun, ShowsPositionAndThenMemoryToAPolicyOfBoth) {
  const auto spec_of = [&](const std::string& state) {
    return observation_of(load_run(written("state = \"" + state + "\"\nremembered_steps = 3\n"))).spec;
  };
  const policy::ObservationSpec simple = spec_of("simple");
  const policy::ObservationSpec memory = spec_of("memory");
  const policy::ObservationSpec both = spec_of("position_memory");
  ASSERT_EQ(both.size(), simple.size() + memory.size());
  for (std::size_t i = 0; i < both.size(); ++i) EXPECT_EQ(both[i], i < simple.size() ? simple[i] : memory[i - simple.size()]) << i;
}

TEST(TrainingRun, RemembersAsManyStepsAsAnObservationHolds) {
  using description::State;
  EXPECT_EQ(description::most_remembered(State::kMemory), 21U);          // 21 * 3 = 63 of 64 elements
  EXPECT_EQ(description::most_remembered(State::kPositionMemory), 20U);  // 2 + 20 * 3 = 62
  for (const State state : {State::kMemory, State::kPositionMemory}) {
    const std::size_t most = description::most_remembered(state);
    const std::size_t size = description::observation_of(state, most, {}).spec.size();
    EXPECT_EQ(size, most * 3 + (state == State::kPositionMemory ? 2 : 0)) << description::name_of(state);
  }
}

TEST(TrainingRun, ReportsEveryProblemAtOnceWithItsLine) {
  const std::string path = written("seeed = 1\n[ppo]\nbatch_size = 1\ndiscount = 1.5\n[search]\ndirections = 33\n");
  const std::string text = complaint_of(path);
  EXPECT_NE(text.find(path + ":1: seeed"), std::string::npos) << text;
  EXPECT_TRUE(support::has_line(text, {path, "3", "ppo.batch_size", "1", "2"})) << text;
  EXPECT_NE(text.find(path + ":4: ppo.discount = 1.5"), std::string::npos) << text;
  EXPECT_NE(text.find(path + ":6: search.directions = 33"), std::string::npos) << text;
}

TEST(TrainingRun, RefusesABatchLargerThanTheRollout) {
  const std::string path = written("[ppo]\nenvironments = 4\nsteps_per_rollout = 16\nbatch_size = 65\n");
  EXPECT_TRUE(support::tells(complaint_of(path), {path, "4", "ppo.batch_size", "65", "not", "steps_per_rollout", "64"}));
  EXPECT_EQ(load_run(written("[ppo]\nenvironments = 4\nsteps_per_rollout = 16\nbatch_size = 64\n")).hyper.batch_size, 64U);
}

TEST(TrainingRun, RefusesARolloutThatMemoryCannotHoldBeforeItIsMade) {
  const std::string path = written("[ppo]\nenvironments = 8192\nsteps_per_rollout = 513\n");
  EXPECT_TRUE(support::tells(complaint_of(path),
                             {path, "3", "ppo.steps_per_rollout", "513", "steps_per_rollout", "4202496", "not", "4194304 steps"}));
  const std::string longer = written("[ppo]\nsteps_per_rollout = 16777216\n");
  EXPECT_TRUE(support::tells(complaint_of(longer), {longer, "2", "ppo.steps_per_rollout", "16777216", "2 to 4194304"}));
}

TEST(TrainingRun, RefusesNumbersThatNoTrainingCanUse) {
  for (const auto& [key, value, range] :
       std::vector<std::array<std::string, 3>>{{"ppo.learning_rate", "1000000000.0", "above 0 and at most 1"},
                                               {"ppo.clip_range", "1e+30", "above 0 and at most 10"},
                                               {"ppo.reward_scale", "1e+30", "above 0 and at most 1000000"},
                                               {"ppo.max_gradient_norm", "0.0", "above 0 and at most 1e+30"},
                                               {"ppo.value_coefficient", "1e+30", "of at least 0 and at most 1000000"},
                                               {"search.domain_north_m", "1e+30", "above 0 and at most 1000000"},
                                               {"search.border_reward", "-1e+30", "of at least -1000000 and at most 1000000"},
                                               {"training_reward.found", "1e+30", "of at least -1000000 and at most 1000000"}}) {
    const std::string table = key.substr(0, key.find('.'));
    const std::string path = written("[" + table + "]\n" + key.substr(table.size() + 1) + " = " + value + "\n");
    EXPECT_EQ(complaint_of(path), path + ":2: " + key + " = " + value + ": must be a finite number " + range);
  }
}

TEST(TrainingRun, SaysOneThingOfADomainThatIsNoNumber) {
  const std::string path = written("[search]\nstart = \"inside_border\"\ndomain_north_m = nan\n");
  const std::string text = complaint_of(path);
  EXPECT_TRUE(support::tells(text, {path, "3", "search.domain_north_m", "nan", "above 0", "at most 1000000"}));
}

TEST(TrainingRun, RefusesAStartInTwoWays) {
  const std::string path = written("[search]\nstart = \"domain\"\nstart_margin_m = 5000.0\n");
  const std::string text = complaint_of(path);
  EXPECT_NE(text.find(path + ":3: search.start_margin_m"), std::string::npos) << text;
}

TEST(TrainingRun, DescribesNumbersSoThatTheyReadBackTheSame) {
  const auto value_of = [](const TrainingRun& run, std::string_view name) {
    for (const auto& [each, value] : describe(run)) {
      if (each == name) return value;
    }
    return std::string("not described");
  };
  TrainingRun run;
  EXPECT_EQ(value_of(run, "learning_rate"), "0.0003");
  EXPECT_EQ(value_of(run, "border_reward"), "-100");
  EXPECT_EQ(value_of(run, "learning_rate_decay_steps"), "not described");
  run.hyper.learning_rate = 1.0 / 3.0;
  run.hyper.clip_range = 0.12345678;
  run.search.border_width = Meters{1'234.5678};
  run.hyper.decay_steps = 10'000'000;
  EXPECT_EQ(std::stod(value_of(run, "learning_rate")), 1.0 / 3.0);
  EXPECT_EQ(value_of(run, "clip_range"), "0.12345678");
  EXPECT_EQ(value_of(run, "border_width_m"), "1234.5678");
  EXPECT_EQ(value_of(run, "learning_rate_decay_steps"), "10000000");
}

TEST(TrainingRun, ListensAsItsFileSaysAndSaysSoInWhatItMakes) {
  const TrainingRun run = load_run(written("[search]\nlistening = \"loudest\"\nlistening_window_s = 30\n"));
  const config::ListeningWindow window{config::Listening::kLoudest, Duration::seconds(30)};
  EXPECT_EQ(run.search.listening, window);
  EXPECT_EQ(observation_of(run).listening, window);
  using Line = std::pair<std::string, std::string>;
  const auto lines = describe(run);
  EXPECT_NE(std::ranges::find(lines, Line("listening", "loudest")), lines.end());
  EXPECT_NE(std::ranges::find(lines, Line("listening_window_s", "30")), lines.end());
  for (const auto& [name, value] : describe(TrainingRun{})) EXPECT_FALSE(name.starts_with("listening")) << name;
  const std::string path = written("[search]\nlistening_window_s = 30\n");
  EXPECT_TRUE(support::tells(complaint_of(path), {path, "2", "search.listening_window_s", "30", "newest", "without", "not", "30 s"}));
}

TEST(TrainingRun, RefusesABorderThatLeavesNoRoomToStartIn) {
  EXPECT_THROW((void)load_run(written("[search]\nstart = \"inside_border\"\nborder_width_m = 12500.0\n")), host::BadInput);
}

}  // namespace
}  // namespace earshot::ppo
