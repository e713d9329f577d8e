// The commands as a person meets them: what they make, and what they say of bad input.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
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
  int run(const std::string& words) {
    const std::string command = "cd '" + folder.string() + "' && '" EARSHOT_BIN_DIR "/earshot-" + words.substr(0, words.find(' ')) + "'" +
                                words.substr(words.find(' ')) + " >out 2>err";
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
  EXPECT_EQ(json["draw"], "sampled");
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
  refuses("evaluate " + kShipped, {"--environment"});
  refuses("evaluate " + kShipped + kOcean + " --episodes 0", {"--episodes", "0"});
  refuses("evaluate " + kShipped + kOcean + " --json nowhere/a.json", {"nowhere/a.json", "cannot be written"});
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
  refuses("freeze a.checkpoint --key a.key", {"MODEL", "--output"});
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
