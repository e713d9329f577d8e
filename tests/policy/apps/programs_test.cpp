// The commands as a person meets them: what they make, and what they say of bad input.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const std::string kSource = EARSHOT_SOURCE_DIR;
const std::string kOcean = " --environment " + kSource + "/sim/ocean/environments/munk_flat.toml";
const std::string kShipped = kSource + "/policy/frozen/fixed_source.policy";

std::string content(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

class Programs : public testing::Test {
 protected:
  Programs() {
    folder = fs::path(testing::TempDir()) / ("programs_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Programs() override { fs::remove_all(folder); }

  /// Runs `earshot-<words>` in the test's folder; returns its exit status.
  int run(const std::string& words, const std::string& launcher = "") {
    const std::string command = "cd '" + folder.string() + "' && " + launcher + "'" EARSHOT_BIN_DIR "/earshot-" +
                                words.substr(0, words.find(' ')) + "'" + words.substr(words.find(' ')) + " >out 2>err";
    const int status = std::system(command.c_str());  // NOLINT: our own programs
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// Exit status 2, one line on standard error that holds every one of `parts`, and nothing left in the folder.
  void refuses(const std::string& words, std::initializer_list<std::string> parts) {
    const auto files_before = files();
    EXPECT_EQ(run(words), 2) << words;
    const std::string said = content(folder / "err");
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
    for (const std::string& part : parts) EXPECT_NE(said.find(part), std::string::npos) << part << " is not in: " << said;
    EXPECT_EQ(files(), files_before) << "left something behind: " << words;
  }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name != "out" && name != "err") names.push_back(name);
    }
    std::ranges::sort(names);
    return names;
  }

  fs::path folder;
};

TEST_F(Programs, TrainFreezeAndEvaluateMakeAPolicyThatFlies) {
  ASSERT_EQ(run("train" + kOcean + " --episodes 40 --seed 3 -o a.checkpoint"), 0) << content(folder / "err");
  const std::string curve = content(folder / "a.csv");
  EXPECT_EQ(curve.substr(0, curve.find('\n')), "episode,steps,reward,found");
  EXPECT_EQ(std::ranges::count(curve, '\n'), 41);
  ASSERT_EQ(run("freeze a.checkpoint -o a.policy --key a.key --new-key"), 0) << content(folder / "err");
  EXPECT_EQ(fs::status(folder / "a.key").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_EQ(run("evaluate a.policy" + kOcean + " --episodes 20 --json a.json"), 0) << content(folder / "err");
  const auto json = nlohmann::json::parse(content(folder / "a.json"));
  EXPECT_EQ(json["episodes"], 20);
  ASSERT_EQ(json["results"].size(), 1U);
  EXPECT_EQ(json["results"][0]["policy"], "a.policy");
  EXPECT_EQ(files(), (std::vector<std::string>{"a.checkpoint", "a.csv", "a.json", "a.key", "a.policy", "a.pub"}));
}

TEST_F(Programs, TrainMakesTheSameCheckpointFromTheSameSeed) {
  ASSERT_EQ(run("train" + kOcean + " --steps 2048 --seed 3 -o a.checkpoint"), 0);
  const std::string first = content(folder / "a.checkpoint");
  ASSERT_EQ(run("train" + kOcean + " --steps 2048 --seed 3 -o a.checkpoint"), 0);
  EXPECT_EQ(content(folder / "a.checkpoint"), first);
}

TEST_F(Programs, FreezeWritesIntoTheProvenanceWhereThePolicyComesFrom) {
  ASSERT_EQ(run("train" + kOcean + " --steps 2048 --seed 3 -o a.checkpoint"), 0);
  ASSERT_EQ(run("freeze a.checkpoint -o a.policy --key a.key --new-key"), 0);
  const std::string bytes = content(folder / "a.policy");
  for (const std::string part : {"command = earshot-train --environment", "commit = ", "environment = munk_flat.toml",
                                 "environment_crc32 = ", "seed = 3", "learning_rate = 0.0003"}) {
    EXPECT_NE(bytes.find(part), std::string::npos) << part;
  }
}

TEST_F(Programs, TrainRefusesBadInputInOneLine) {
  std::ofstream(folder / "bad.toml") << "episode = 5\n";
  std::ofstream(folder / "ocean.toml") << content(kSource + "/sim/ocean/environments/munk_flat.toml") << "\n[sky]\n";
  refuses("train -o a.checkpoint", {"--environment"});
  refuses("train --environment none.toml -o a.checkpoint", {"none.toml", "no such file"});
  refuses("train --environment ocean.toml -o a.checkpoint", {"ocean.toml", "sky", "unknown key"});
  refuses("train none.toml -o a.checkpoint", {"none.toml", "no such file"});
  refuses("train bad.toml" + kOcean + " -o a.checkpoint", {"bad.toml:1", "episode", "unknown key"});
  refuses("train" + kOcean + " --episodes 1 -o nowhere/a.checkpoint", {"nowhere/a.checkpoint", "cannot be written"});
  refuses("train" + kOcean + " --state both -o a.checkpoint", {"--state", "both"});
  refuses("train" + kOcean + " --border-width-m -5 -o a.checkpoint", {"--border-width-m", "-5"});
  refuses("train" + kOcean + " --start inside_border --border-width-m 12500 -o a.checkpoint", {"--border-width-m"});
  refuses("train" + kOcean + " --vehicle-depth-m 3000 -o a.checkpoint", {"--vehicle-depth-m", "sea floor"});
  refuses("train" + kOcean + " --frobnicate -o a.checkpoint", {"frobnicate"});
  refuses("train" + kOcean, {"--output"});
}

TEST_F(Programs, EvaluateRefusesBadInputInOneLine) {
  std::string bytes = content(kShipped);
  std::ofstream(folder / "short.policy", std::ios::binary) << bytes.substr(0, 1'000);
  bytes[500] = static_cast<char>(bytes[500] ^ 4);
  std::ofstream(folder / "flipped.policy", std::ios::binary) << bytes;
  refuses("evaluate none.policy" + kOcean, {"none.policy", "no such file"});
  refuses("evaluate flipped.policy" + kOcean, {"flipped.policy", "CRC-32"});
  refuses("evaluate short.policy" + kOcean, {"short.policy"});
  refuses("evaluate --episodes 3", {"no policy"});
  refuses("evaluate --policies bayes,swordfish", {"swordfish", "bayes_infogain"});
  refuses("evaluate --policies oracle --environment none.toml", {"none.toml", "no such file"});
  refuses("evaluate --policies oracle --world none.toml", {"none.toml", "no such file"});
  refuses("evaluate --policies oracle --plot a.gif", {"a.gif", ".png or .svg"});
  std::ofstream(folder / "bad.toml") << "name = \"a\"\nwhat = \"b\"\nseed = 1\nenvironment = \"" << kSource
                                     << "/sim/ocean/environments/munk_flat.toml\"\n[conditions]\nfluctuation_db = -1.0\n";
  refuses("evaluate --policies oracle --world bad.toml", {"bad.toml:6", "fluctuation_db", "at least 0"});
  refuses("evaluate " + kShipped + kOcean + " --episodes 0", {"--episodes", "0"});
  refuses("evaluate " + kShipped + kOcean + " --json nowhere/a.json", {"nowhere/a.json", "cannot be written"});
}

TEST_F(Programs, EvaluateNeedsNothingButTheNamesOfPolicies) {
  ASSERT_EQ(run("evaluate --policies shipped,bayes,oracle --episodes 30 --json a.json --csv a.csv --plot a.svg"), 0)
      << content(folder / "err");
  const auto json = nlohmann::json::parse(content(folder / "a.json"));
  EXPECT_EQ(json["source"], "changing");
  EXPECT_EQ(json["start"], "inside_border");
  ASSERT_EQ(json["results"].size(), 3U);
  EXPECT_EQ(json["results"][0]["policy"], "shipped");
  EXPECT_EQ(json["results"][2]["found_fraction"], 1.0) << "an oracle that heeds no border finds every source";
  EXPECT_GE(json["results"][2]["path_over_straight"], 1.0);
  EXPECT_EQ(std::ranges::count(content(folder / "a.csv"), '\n'), 4);
  EXPECT_EQ(content(folder / "a.svg").substr(0, 5), "<?xml");
  EXPECT_NE(content(folder / "out").find("us/decision"), std::string::npos);
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

TEST_F(Programs, EvaluateWritesTheSameBytesFromTwoRanks) {
  if (std::string(EARSHOT_MPIEXEC).empty()) GTEST_SKIP() << "built without MPI";
  const std::string words = "evaluate --policies shipped,bayes,random --episodes 31 --world " + kSource + "/policy/worlds/noisy_4db.toml";
  // As root runs it in containers; --oversubscribe where there is one core.
  const std::string launcher = std::string(EARSHOT_MPIEXEC) + " --allow-run-as-root --oversubscribe -n 2 ";
  ASSERT_EQ(run(words + " --json one.json --csv one.csv"), 0) << content(folder / "err");
  ASSERT_EQ(run(words + " --json two.json --csv two.csv", launcher), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "one.json"), content(folder / "two.json"));
  EXPECT_EQ(content(folder / "one.csv"), content(folder / "two.csv"));
  EXPECT_NE(run("evaluate --policies swordfish", launcher), 0);
}

TEST_F(Programs, FreezeRefusesBadInputInOneLine) {
  ASSERT_EQ(run("train" + kOcean + " --episodes 1 -o a.checkpoint"), 0);
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0);
  std::ofstream(folder / "cut.checkpoint") << content(folder / "a.checkpoint").substr(0, 1'000);
  std::ofstream(folder / "word.key") << "swordfish\n";
  const std::string key = content(folder / "a.key");
  refuses("freeze none.checkpoint -o a.policy --key a.key", {"none.checkpoint", "no such file"});
  refuses("freeze cut.checkpoint -o a.policy --key a.key", {"cut.checkpoint", "cut short"});
  refuses("freeze a.checkpoint -o a.policy --key none.key", {"none.key", "--new-key"});
  refuses("freeze a.checkpoint -o a.policy --key word.key", {"word.key", "64 hexadecimal digits"});
  refuses("freeze a.checkpoint -o a.policy --key a.key --new-key", {"a.key", "exists"});
  refuses("freeze a.checkpoint -o nowhere/a.policy --key a.key", {"nowhere/a.policy", "cannot be written"});
  refuses("freeze a.checkpoint --key a.key", {"CHECKPOINT", "--output"});
  refuses("freeze a.checkpoint -o a.policy --key a.key --draw dice", {"--draw", "dice"});
  EXPECT_EQ(content(folder / "a.key"), key);
}

TEST_F(Programs, HelpExplainsItselfAndEndsWell) {
  for (const std::string verb : {"train", "evaluate", "freeze"}) {
    EXPECT_EQ(run(verb + " --help"), 0);
    EXPECT_NE(content(folder / "out").find("Example: earshot " + verb), std::string::npos);
  }
}

}  // namespace
