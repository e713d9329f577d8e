// earshot evaluate as a person meets it.
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/policy/apps/programs.hpp"
#include "tests/support/terminal.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::policy_programs {
namespace {

TEST_F(Programs, EvaluateRefusesBadInputInOneLine) {
  std::string bytes = content(kFixedSource);
  std::ofstream(folder / "short.policy", std::ios::binary) << bytes.substr(0, 1'000);
  bytes[500] = static_cast<char>(bytes[500] ^ 4);
  std::ofstream(folder / "flipped.policy", std::ios::binary) << bytes;
  refuses("evaluate none.policy" + kOcean, {"none.policy", "no such file"});
  refuses("evaluate flipped.policy" + kOcean, {"flipped.policy", "CRC-32"});
  refuses("evaluate short.policy" + kOcean, {"short.policy"});
  refuses("evaluate --episodes 3", {"no policy"});
  refuses("evaluate --policies bayes,swordfish", {"swordfish", "bayes_least_regret"});
  refuses("evaluate --policies oracle --environment none.toml", {"none.toml", "no such file"});
  refuses("evaluate --policies oracle --world none.toml", {"none.toml", "no such file"});
  refuses("evaluate --policies oracle --plot a.gif", {"a.gif", ".png or .svg"});
  refuses("evaluate --policies oracle --listening softest", {"--listening", "softest", "loudest"});
  for (const std::string seconds : {"-1", "1.5", "121"})
    refuses("evaluate --policies oracle --listening mean --listening-window-s " + seconds,
            {"--listening-window-s: " + seconds + ": must be whole seconds, 1 to 120, or 0 with newest"});
  refuses("evaluate --policies oracle --listening mean", {"--listening-window-s", "\"mean\" needs a window of 1 to 120 s, not 0"});
  refuses("evaluate --policies oracle --listening-window-s 30", {"--listening-window-s", "\"newest\" goes without a window"});
  refuses("evaluate --policies oracle --csv a --json a", {"--json a, --csv a", "the same file"});
  refuses("evaluate --policies oracle --world \xC0\xAF.toml", {"the command line holds bytes that are not UTF-8"});
  std::ofstream(folder / "bad.toml") << "name = \"a\"\nwhat = \"b\"\nseed = 1\nenvironment = \"" << kSource
                                     << "/sim/ocean/environments/munk_flat.toml\"\n[conditions]\nfluctuation_db = -1.0\n";
  refuses("evaluate --policies oracle --world bad.toml", {"bad.toml:6", "fluctuation_db", "at least 0"});
  refuses("evaluate " + kFixedSource + kOcean + " --episodes 0", {"--episodes", "0"});
  refuses("evaluate " + kFixedSource + kOcean + " --json nowhere/a.json", {"nowhere/a.json", "cannot be written"});
}

TEST_F(Programs, EvaluateSaysInOneLineWhatIsGivenInAnothersPlace) {
  const std::string rock = kSource + "/policy/worlds/rock.toml";
  refuses("evaluate --policies oracle --suite --world " + rock, {"--suite, --world " + rock, "give one of the two"});
  refuses("evaluate --policies oracle --world " + rock + " " + rock, {"--world " + rock + ": is given twice"});
  refuses("evaluate --policies oracle --environment " + rock, {"--environment " + rock + ": is a world", "not an environment"});
  refuses("evaluate --policies oracle --mission " + rock, {"--mission " + rock + ": is a world", "not a mission"});
}

/// The mission that ships with other numbers.
void write_mission(const fs::path& path, const std::vector<std::pair<std::string, std::string>>& changes) {
  const std::string missions = kSource + "/firmware/boards/linux/missions/";
  std::string text = content(missions + "search.toml");
  const auto change = [&text](const std::string& line, const std::string& instead) {
    const std::size_t at = text.find(line);
    ASSERT_NE(at, std::string::npos) << line;
    text.replace(at, line.size(), instead);
  };
  change("\"../../../../policy/frozen/shipped.policy\"", "\"" + kSource + "/policy/frozen/shipped.policy\"");
  change("\"../../../../policy/frozen/earshot.pub\"", "\"" + kSource + "/policy/frozen/earshot.pub\"");
  for (const auto& [line, instead] : changes) change(line, instead);
  std::ofstream(path) << text;
}

TEST_F(Programs, EvaluateSearchesAsAMissionSays) {
  write_mission(folder / "slow.toml", {{"speed_mps = 2.0", "speed_mps = 0.5"}, {"depth_m = 300.0", "depth_m = 100.0"}});
  ASSERT_EQ(run("evaluate --mission slow.toml --episodes 3 --json slow.json"), 0) << content(folder / "err");
  EXPECT_TRUE(support::has_line(content(folder / "out"), {"slow.toml", "100 m", "0.5 m/s", "at most 30 steps", "1000 m", "100"}))
      << content(folder / "out");  // 60000 s of 2000 s each
  const auto json = nlohmann::json::parse(content(folder / "slow.json"));
  EXPECT_EQ(json["results"][0]["policy"], "shipped.policy") << "the mission's";
  EXPECT_EQ(json["worlds"][0]["vehicle_depth_m"], 100.0);
  EXPECT_EQ(json["max_steps"], 30);
  EXPECT_EQ(json["listening"], "mean");
  const double steps = json["results"][0]["restricted_mean_steps_to_find"];
  EXPECT_NEAR(json["results"][0]["restricted_mean_hours_to_find"].get<double>(), steps * 2'000.0 / 3'600.0, 1e-9);
  // Options go before the mission, and the mission before a world.
  ASSERT_EQ(run("evaluate --mission slow.toml --max-steps 5 --policies oracle --episodes 3 --json five.json --world " + kSource +
                "/policy/worlds/rock.toml"),
            0)
      << content(folder / "err");
  const auto five = nlohmann::json::parse(content(folder / "five.json"));
  EXPECT_EQ(five["max_steps"], 5);
  EXPECT_EQ(five["worlds"][0]["vehicle_depth_m"], 100.0);
}

TEST_F(Programs, EvaluateWarnsOfAMissionOfOnesOwnThatIsFlownInTheOceanThatShipsAndOfNoTrainingOfAPolicyThatHadNone) {
  write_mission(folder / "own.toml", {{"depth_m = 300.0", "depth_m = 100.0"}});
  const std::string ocean_warning =
      "warning: no --environment is given: own.toml is flown in the ocean of munk_flat.toml, whose sea floor lies at 3000 m";
  ASSERT_EQ(run("evaluate --mission own.toml --episodes 3"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "err").find(ocean_warning + "\n"), std::string::npos) << content(folder / "err");
  EXPECT_EQ(content(folder / "err").find("was trained"), std::string::npos) << content(folder / "err");
  std::istringstream lines(content(folder / "out"));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  std::ofstream(folder / "ocean.toml") << "# beside it\n";
  ASSERT_EQ(run("evaluate --mission own.toml --episodes 3"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "err").find(ocean_warning + "; ocean.toml lies beside the mission\n"), std::string::npos)
      << content(folder / "err");
  for (const std::string& ocean :
       {"--environment " + kSource + "/sim/ocean/environments/munk_flat.toml", "--world " + kSource + "/policy/worlds/rock.toml"}) {
    ASSERT_EQ(run("evaluate --mission own.toml --episodes 3 " + ocean), 0) << content(folder / "err");
    EXPECT_EQ(content(folder / "err").find("no --environment"), std::string::npos) << content(folder / "err");
  }
  ASSERT_EQ(run("evaluate --episodes 3 --mission " + kSource + "/firmware/boards/linux/missions/search.toml"), 0)
      << content(folder / "err");
  EXPECT_EQ(content(folder / "err").find("no --environment"), std::string::npos) << "a mission that ships";
}

TEST_F(Programs, EvaluateRefusesAMissionThatIsNotThePolicysOrWouldBeDeafInTheWorld) {
  write_mission(folder / "small.toml", {{"north_m = 25000.0", "north_m = 20000.0"}});
  refuses("evaluate --mission small.toml --policies shipped",
          {"--mission small.toml: area, south to north = 20000 m, but shipped is for 25000 m"});
  write_mission(folder / "step.toml", {{"step_length_m = 1000.0", "step_length_m = 500.0"}});
  refuses("evaluate --mission step.toml", {"search.step_length_m = 500 m, but shipped.policy is for 1000 m"});
  write_mission(folder / "deaf.toml", {{"source_frequency_hz = 20.0", "source_frequency_hz = 35.0"}});
  refuses("evaluate --mission deaf.toml --policies oracle", {"searches for a sound of 35 Hz, but the source of munk_flat is of 20 Hz"});
  write_mission(folder / "deep.toml", {{"depth_m = 300.0", "depth_m = 3500.0"}, {"max_depth_m = 400.0", "max_depth_m = 4000.0"}});
  refuses("evaluate --mission deep.toml --policies oracle", {"depth of the sea floor"});
  refuses("evaluate --mission none.toml", {"none.toml: no such file"});
}

TEST_F(Programs, EvaluateLeavesAPipe) {
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  refuses("evaluate --policies oracle --episodes 1 --force --csv pipe", {"pipe: cannot be written: it is a pipe"});
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

TEST_F(Programs, EvaluateNeedsNothingButTheNamesOfPolicies) {
  ASSERT_EQ(run("evaluate --policies shipped,bayes,oracle --episodes 30 --json a.json --csv a.csv --plot a.svg"), 0)
      << content(folder / "err");
  const auto json = nlohmann::json::parse(content(folder / "a.json"));
  EXPECT_EQ(json["source"], "changing");
  EXPECT_EQ(json["start"], "inside_border");
  EXPECT_FALSE(json.contains("start_margin_m"));
  ASSERT_EQ(json["results"].size(), 3U);
  EXPECT_EQ(json["results"][0]["policy"], "shipped");
  EXPECT_EQ(json["results"][2]["found_fraction"], 1.0) << "an oracle that heeds no border finds every source";
  EXPECT_GE(json["results"][2]["path_over_straight"], 1.0);
  EXPECT_EQ(std::ranges::count(content(folder / "a.csv"), '\n'), 4);
  EXPECT_EQ(content(folder / "a.svg").substr(0, 5), "<?xml");
  EXPECT_TRUE(support::has_line(content(folder / "out"), {"found", "95 %", "mean", "95 %"})) << content(folder / "out");
}

TEST_F(Programs, EvaluateWritesTheMarginOfItsStartsInPlaceOfTheirRegion) {
  ASSERT_EQ(run("evaluate --policies random --episodes 3 --start-margin-m 5000 --json \u00E4.json"), 0) << content(folder / "err");
  const auto json = nlohmann::json::parse(content(folder / "\u00E4.json"));
  EXPECT_EQ(json["start_margin_m"], 5'000.0);
  EXPECT_FALSE(json.contains("start"));
}

TEST_F(Programs, EvaluateFliesTheSameStartsForEveryPolicyInEveryOrder) {
  ASSERT_EQ(run("evaluate --policies oracle,gradient --episodes 40 --csv a.csv"), 0);
  ASSERT_EQ(run("evaluate --policies gradient,oracle --episodes 40 --csv b.csv"), 0);
  const auto lines_of = [&](const char* file) {
    std::istringstream stream(content(folder / file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    std::ranges::sort(lines);
    return lines;
  };
  EXPECT_EQ(lines_of("a.csv"), lines_of("b.csv"));
}

TEST_F(Programs, EvaluateSearchesInWorldsWithTheirOwnSeeds) {
  const std::string worlds = kSource + "/policy/worlds/";
  ASSERT_EQ(run("evaluate --policies oracle --episodes 20 --world " + worlds + "noisy_4db.toml " + worlds + "hilly.toml --json a.json"), 0)
      << content(folder / "err");
  const auto json = nlohmann::json::parse(content(folder / "a.json"));
  EXPECT_EQ(json["worlds"][0]["seed"], 1002);
  ASSERT_EQ(json["results"].size(), 2U);
  EXPECT_EQ(json["results"][1]["world"], "hilly");
  EXPECT_GT(json["results"][1]["mean_detections"], 0.0);
}

TEST_F(Programs, EvaluateSearchesAtTheDepthOfAWorldUnlessToldAnother) {
  const auto world = [&](const std::string& depth) {
    std::ofstream(folder / "own.toml") << "name = \"own\"\nwhat = \"b\"\nseed = 1\nenvironment = \"" << kSource
                                       << "/sim/ocean/environments/munk_flat.toml\"\n"
                                       << depth;
    return std::string(" --policies bayes --episodes 10 --force --world own.toml --json ");
  };
  // Both what is heard and what bayes expects to hear are those of 100 m.
  ASSERT_EQ(run("evaluate" + world("") + "told.json --vehicle-depth-m 100"), 0) << content(folder / "err");
  ASSERT_EQ(run("evaluate" + world("vehicle_depth_m = 100.0\n") + "own.json"), 0) << content(folder / "err");
  ASSERT_EQ(run("evaluate" + world("vehicle_depth_m = 200.0\n") + "both.json --vehicle-depth-m 100"), 0) << content(folder / "err");
  ASSERT_EQ(run("evaluate" + world("") + "usual.json"), 0) << content(folder / "err");
  const auto results = [&](const char* file) { return nlohmann::json::parse(content(folder / file))["results"]; };
  EXPECT_EQ(results("own.json"), results("told.json"));
  EXPECT_EQ(results("both.json"), results("told.json"));
  EXPECT_NE(results("usual.json"), results("told.json"));
  refuses("evaluate" + world("vehicle_depth_m = 3001.0\n") + "a.json", {"own.toml:5: vehicle_depth_m: 3001", "3000 m"});
}

TEST_F(Programs, EvaluateListensOverTheWindowThatItIsTold) {
  // A straight line to the source; a pulse every 15 s falls into the last second of a step in one of fifteen, into the last 30 s of every
  // one.
  const std::string pulses =
      "evaluate --policies oracle --episodes 20 --world " + kSource + "/policy/worlds/pulses.toml --json a.json --force";
  const auto detections_per_step = [&](const std::string& listening) {
    EXPECT_EQ(run(pulses + listening), 0) << content(folder / "err");
    const auto json = nlohmann::json::parse(content(folder / "a.json"));
    EXPECT_EQ(json["listening"], listening.empty() ? "newest" : "loudest");
    EXPECT_EQ(json["listening_window_s"], listening.empty() ? 0 : 30);
    return json["results"][0]["mean_detections"].get<double>() / json["results"][0]["mean_steps"].get<double>();
  };
  EXPECT_LT(detections_per_step(""), 0.2);
  EXPECT_GT(detections_per_step(" --listening loudest --listening-window-s 30"), 0.3);
  EXPECT_NE(content(folder / "out").find("hears the loudest of 30 s"), std::string::npos);
}

TEST_F(Programs, EvaluateWritesTheSameBytesFromTwoRanks) {
  if (std::string(EARSHOT_MPIEXEC).empty()) GTEST_SKIP() << "built without MPI";
  const std::string words = "evaluate --policies shipped,bayes,random --episodes 7 --world " + kSource + "/policy/worlds/noisy_4db.toml";
  // As root runs it in containers; --oversubscribe where there is one core.
  const std::string launcher = std::string(EARSHOT_MPIEXEC) + " --allow-run-as-root --oversubscribe -n 2";
  ASSERT_EQ(run(words + " --json one.json --csv one.csv"), 0) << content(folder / "err");
  ASSERT_EQ(run(words + " --json two.json --csv two.csv", launcher), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "one.json"), content(folder / "two.json"));
  EXPECT_EQ(content(folder / "one.csv"), content(folder / "two.csv"));
  EXPECT_NE(run("evaluate --policies swordfish", launcher), 0);
  // Only rank 0 writes; that it cannot must end the others too.
  EXPECT_NE(run("evaluate --policies random --episodes 7 --json nowhere/two.json", launcher), 0);
}

TEST_F(Programs, EvaluateNamesTheShippedPolicyWhenItIsMissingRatherThanTakeAnother) {
  fs::create_directories(folder / "bin");  // an installation
  const fs::path frozen = folder / "share/earshot/policy/frozen";
  fs::create_directories(frozen);
  fs::copy_file(kFixedSource, frozen / "fixed_source.policy");
  fs::copy_file(EARSHOT_BIN_DIR "/earshot-evaluate", folder / "bin/earshot-evaluate");
  const std::vector<std::string> arguments = split("--policies shipped --episodes 1" + kOcean);
  EXPECT_EQ(start(folder / "bin/earshot-evaluate", arguments).wait(kPatience), 2);
  const std::string said = content(folder / "err");
  EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
  EXPECT_TRUE(support::has_line(said, {"policy/frozen/shipped.policy", "neither installed", "beside"})) << said;
}

/// Without the breaks that keep a line within a terminal.
std::string unwrapped(std::string text) {
  for (std::size_t at = text.find("\n  "); at != std::string::npos; at = text.find("\n  ", at)) text.replace(at, 3, " ");
  return text;
}

TEST_F(Programs, EvaluateSearchesForTheSourceThatAPolicyWasTrainedWith) {
  // Of a changing source it finds one in ten.
  ASSERT_EQ(run("evaluate " + kFixedSource + " --episodes 40 --json fixed.json"), 0) << content(folder / "err");
  const auto fixed = nlohmann::json::parse(content(folder / "fixed.json"));
  EXPECT_EQ(fixed["source"], "fixed");
  EXPECT_GT(fixed["results"][0]["found_fraction"], 0.9);
  EXPECT_EQ(fixed["start"], "domain");
  EXPECT_EQ(fixed["trained_by"], kFixedSource);
  EXPECT_EQ(fixed["warnings"], nlohmann::json::array());
  EXPECT_TRUE(support::tells(unwrapped(content(folder / "out")),
                             {"source fixed", "10000 m north", "10000 m east", kFixedSource, "starts all over the area", kFixedSource}));
  EXPECT_EQ(content(folder / "err"), "");
  ASSERT_EQ(run("evaluate --policies shipped --episodes 1 --json changing.json"), 0) << content(folder / "err");
  EXPECT_EQ(nlohmann::json::parse(content(folder / "changing.json"))["source"], "changing");
  EXPECT_TRUE(support::has_line(content(folder / "out"), {"source changing", "shipped", "made for"})) << "it has no network to train";
}

TEST_F(Programs, EvaluateShowsOnATerminalHowFarItIs) {
  // The first bar comes after a second of work that takes minutes.
  const std::string bar = "munk_flat, bayes [.....";
  const support::Shown shown =
      support::shown_on_terminal(EARSHOT_BIN_DIR "/earshot-evaluate", {"--policies", "bayes", "--episodes", "1000000"}, bar);
  EXPECT_NE(shown.text.find(bar), std::string::npos) << shown.text;
}

TEST_F(Programs, EvaluateWarnsWhenToldToTestAnotherTaskThanAPolicyWasTrainedFor) {
  ASSERT_EQ(run("evaluate " + kFixedSource + " --source changing --start-margin-m 2000 --episodes 1 --json a.json"), 0);
  const std::string said = content(folder / "err");
  const auto warnings = nlohmann::json::parse(content(folder / "a.json"))["warnings"];
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_TRUE(support::tells(warnings[0].get<std::string>(), {kFixedSource, "trained", "changing", "one"}));
  EXPECT_TRUE(support::tells(warnings[1].get<std::string>(), {kFixedSource, "trained", "anywhere", "2000 m"}));
  for (const auto& warning : warnings)
    EXPECT_NE(said.find("earshot evaluate: warning: " + warning.get<std::string>() + "\n"), std::string::npos) << said;
  EXPECT_EQ(std::ranges::count(said, '\n'), 2) << said;
}

TEST_F(Programs, EvaluateTakesAWholeTaskFromATrainingAndLooksForTheSourceWhereItStood) {
  std::string ocean = content(kSource + "/sim/ocean/environments/munk_flat.toml");
  const std::string north = "north_m = 10_000.0";
  ASSERT_NE(ocean.find(north), std::string::npos);
  std::ofstream(folder / "elsewhere.toml") << ocean.replace(ocean.find(north), north.size(), "north_m = 7_000.0");
  ASSERT_EQ(
      run("train --environment elsewhere.toml --steps 2048 --start-margin-m 3000 --border-width-m 500 --max-steps 40 --vehicle-depth-m 250 "
          "-o a.checkpoint"),
      0)
      << content(folder / "err");
  ASSERT_EQ(run("freeze a.checkpoint -o a.policy --key a.key --new-key"), 0) << content(folder / "err");
  ASSERT_EQ(run("evaluate a.policy --episodes 3 --json a.json"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "err"), "");
  const auto json = nlohmann::json::parse(content(folder / "a.json"));
  EXPECT_EQ(json["source_north_m"], 7'000.0);
  EXPECT_EQ(json["start_margin_m"], 3'000.0);
  EXPECT_EQ(json["border_width_m"], 500.0);
  EXPECT_EQ(json["max_steps"], 40);
  EXPECT_EQ(json["worlds"][0]["vehicle_depth_m"], 250.0);
  ASSERT_EQ(run("evaluate a.policy --episodes 3" + kOcean), 0) << content(folder / "err");
  EXPECT_TRUE(support::has_line(content(folder / "err"), {"a.policy", "7000 m north", "10000 m east", "10000 m north"}))
      << content(folder / "err");
}

TEST_F(Programs, EvaluateIsNeverSureOfAChance) {
  ASSERT_EQ(run("evaluate --policies oracle --episodes 10 --json a.json"), 0) << content(folder / "err");
  const auto row = nlohmann::json::parse(content(folder / "a.json"))["results"][0];
  EXPECT_EQ(row["found_fraction"], 1.0);
  EXPECT_NEAR(row["found_fraction_95"][0].get<double>(), 0.6915, 5e-5);
  EXPECT_EQ(row["found_fraction_95"][1], 1.0);
  EXPECT_NE(content(folder / "out").find(" 100.0   69.2 to 100.0 "), std::string::npos) << content(folder / "out");
}

TEST_F(Programs, EvaluateAsksWhichSourceIsMeantWhenPoliciesWereTrainedWithBothKinds) {
  refuses("evaluate --policies shipped," + kFixedSource,
          {"shipped was trained with a changing source", kFixedSource + " with a fixed one", "--source"});
}

}  // namespace
}  // namespace earshot::policy_programs
