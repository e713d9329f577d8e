// GIVEN a mission, WHEN earshotd --check judges it, THEN it says what will happen or what is wrong, and changes nothing but the chart.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/firmware/for_no_root.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

using namespace std::chrono_literals;

const std::filesystem::path kMissions = std::filesystem::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions";

class CheckRun : public ::testing::Test {
 protected:
  int check(const std::vector<std::string>& arguments) { return check(arguments, folder_ / "out"); }
  int check(std::vector<std::string> arguments, const std::filesystem::path& out) {
    arguments.insert(arguments.end(), {"--out", out.string()});
    support::Process process(std::filesystem::path(EARSHOT_BIN_DIR) / "earshotd", arguments, folder_ / "said.txt");
    const int status = process.wait(30s);
    output_ = process.output();
    return status;
  }

  const support::TemporaryFolder folder_;
  std::string output_;
};

TEST_F(CheckRun, IsReadyToDiveAndLeavesNothingBehind) {
  EXPECT_EQ(check({"--check", (kMissions / "fenced_search.toml").string()}), 0);
  EXPECT_TRUE(support::tells(support::last_line(output_), {"ready to dive", "doubt"})) << output_;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(CheckRun, JudgesAMissionOverCanWhereThereIsNoBus) {
  EXPECT_EQ(check({"--check", (kMissions / "search_over_can.toml").string(), "--can-interface", "nosuchbus0"}), 0);
  EXPECT_TRUE(support::has_line(output_, {"doubt", "no", "nosuchbus0", "now"})) << output_;
}

TEST_F(CheckRun, DrawsTheChartAndReplacesItButNothingElse) {
  const std::filesystem::path chart = folder_ / "chart.svg";
  for (int i = 0; i < 2; ++i) EXPECT_EQ(check({"--check", (kMissions / "search.toml").string(), "--chart", chart.string()}), 0) << output_;
  EXPECT_EQ(support::read_text(chart).rfind("<svg ", 0), 0U);
  std::ofstream(chart) << "notes of mine";
  EXPECT_EQ(check({"--check", (kMissions / "search.toml").string(), "--chart", chart.string()}), 2);
  EXPECT_NE(output_.find("chart.svg"), std::string::npos) << output_;
  EXPECT_EQ(support::read_text(chart), "notes of mine");
}

TEST_F(CheckRun, SaysItsDoubtsEvenWhenItIsToBeQuiet) {
  EXPECT_EQ(check({"--quiet", "--check", (kMissions / "fenced_search.toml").string()}), 0);
  EXPECT_TRUE(support::tells(support::last_line(output_), {"doubt", "no authority.key_file"})) << output_;
  EXPECT_EQ(output_.find("ready to dive"), std::string::npos) << output_;
}

TEST_F(CheckRun, IsReadyWithoutAWordMoreWhereThereIsNoDoubt) {
  std::filesystem::create_directories(folder_ / "m");
  std::string text = support::read_text(kMissions / "fenced_search.toml");
  for (std::size_t at = 0; (at = text.find("../../../../policy", at)) != std::string::npos;)
    text.replace(at, 12, std::string(EARSHOT_SOURCE_DIR) + "/");
  std::ofstream(folder_ / "m/safe.toml") << text << "[authority]\nkey_file = \"vehicle.key\"\n";
  std::ofstream(folder_ / "m/vehicle.key") << std::string(64, 'a');
  std::filesystem::permissions(folder_ / "m/vehicle.key", std::filesystem::perms::owner_read);
  EXPECT_EQ(check({"--check", (folder_ / "m/safe.toml").string()}), 0) << output_;
  EXPECT_TRUE(output_.ends_with("allowed\nready to dive\n")) << output_;
}

TEST_F(CheckRun, DrawsNoPictureOfAnotherKindThanItsNameSays) {
  EXPECT_EQ(check({"--check", (kMissions / "search.toml").string(), "--chart", (folder_ / "chart.png").string()}), 2);
  EXPECT_TRUE(support::has_line(output_, {"SVG", "picture"})) << output_;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "chart.png"));
}

TEST_F(CheckRun, NamesWhatIsWrongWithTheMission) {
  std::string text = support::read_text(kMissions / "search.toml");
  text.replace(text.find("max_depth_m = 400.0"), 19, "max_depth_m = 100.0");
  std::ofstream(folder_ / "shallow.toml") << text;
  EXPECT_EQ(check({"--check", (folder_ / "shallow.toml").string()}), 2);
  EXPECT_TRUE(support::has_line(output_, {"limits.max_depth_m", "100.0", "at least search.depth_m", (folder_ / "shallow.toml").string()}))
      << output_;
}

TEST_F(CheckRun, NamesThePolicyThatDoesNotFit) {
  EXPECT_EQ(check({"--check", (kMissions / "search.toml").string(), "--policy", (kMissions / "search.toml").string()}), 2);
  EXPECT_NE(output_.find("search.toml"), std::string::npos) << output_;
}

TEST_F(CheckRun, RefusesAPolicyWhoseGoldenTrajectoriesThisProgramDoesNotRepeat) {
  policy::FrozenPolicy policy = support::random_walk_policy();
  policy.observation.listening = {config::Listening::kMean, Duration::seconds(30)};  // as the mission does
  policy.golden[1][2].logits[3] = 1e-9F;
  std::vector<std::uint8_t> bytes(policy::max_serialised_size());
  bytes.resize(policy::serialise(policy, support::public_key(), bytes).value());
  support::sign(bytes);
  const std::filesystem::path other = folder_ / "other.policy";
  support::write_bytes(other, bytes);
  support::write_public_key(folder_ / "other.pub");
  EXPECT_EQ(check({"--check", (kMissions / "search.toml").string(), "--policy", other.string(), "--public-key",
                   (folder_ / "other.pub").string()}),
            2);
  EXPECT_NE(output_.find(other.string() + ": does not repeat its golden"), std::string::npos) << output_;
}

TEST_F(CheckRun, RefusesAnOutputFolderThatCannotBeMade) {
  std::ofstream(folder_ / "out") << "no folder";
  const std::filesystem::path below = folder_ / "out" / "day" / "two";
  EXPECT_EQ(check({"--check", (kMissions / "search.toml").string()}, below), 2);
  EXPECT_NE(output_.find((folder_ / "out" / "day").string() + ": cannot be written"), std::string::npos) << output_;
  // Nobody, not even root, makes a folder there.
  EXPECT_EQ(check({"--check", (kMissions / "search.toml").string()}, "/proc/nothing/here"), 2);
  EXPECT_NE(output_.find("/proc/nothing: cannot be written"), std::string::npos) << output_;
}

TEST_F(CheckRun, OnlyDoubtsTheFolderThatItIsInWhereNoneIsNamedForTheJournal) {
  namespace fs = std::filesystem;
  const fs::path here = folder_ / "others";
  fs::create_directories(here);
  fs::permissions(here, fs::perms::owner_read | fs::perms::owner_exec);
  const auto status_of = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"--check", (kMissions / "search.toml").string()};
    words.insert(words.end(), more.begin(), more.end());
    const support::ForNoRoot earshotd(fs::path(EARSHOT_BIN_DIR) / "earshotd", words);
    support::Process process(earshotd.program, earshotd.arguments, {.folder = here, .output = folder_ / "said.txt", .errors = {}});
    const int status = process.wait(30s);
    output_ = process.output();
    return status;
  };
  EXPECT_EQ(status_of({}), 0) << output_;
  EXPECT_TRUE(support::has_line(output_, {"doubt", (here / "journal.lcmlog").string(), "Permission denied", "--out"})) << output_;
  EXPECT_TRUE(support::tells(support::last_line(output_), {"ready to dive", "doubt"})) << output_;
  EXPECT_EQ(status_of({"--out", "."}), 2) << output_;
}

// A flight leaves the file where it is, and writes journal-2.lcmlog beside it.
TEST_F(CheckRun, RefusesAForeignJournalOnlyWhereItWouldBeReplaced) {
  std::filesystem::create_directories(folder_ / "out");
  std::ofstream(folder_ / "out" / "journal.lcmlog") << "notes of mine";
  EXPECT_EQ(check({"--check", (kMissions / "search.toml").string()}), 0) << output_;
  EXPECT_EQ(check({"--check", (kMissions / "search.toml").string(), "--replace"}), 2);
  EXPECT_TRUE(support::has_line(output_, {"journal.lcmlog", "already", "not", "journal"})) << output_;
  EXPECT_EQ(support::read_text(folder_ / "out" / "journal.lcmlog"), "notes of mine");
}

TEST_F(CheckRun, RefusesWhatAFlightWithTheSameOptionsWouldRefuse) {
  EXPECT_EQ(check({"--check", (kMissions / "search.toml").string(), "--hear"}), 2);
  EXPECT_NE(output_.find("--hear: only with --simulation"), std::string::npos) << output_;
}

TEST_F(CheckRun, RefusesAnSnrFromTheBusAtSeaAndBesideItsOwnEar) {
  const std::string mission = (kMissions / "search.toml").string();
  EXPECT_EQ(check({mission, "--snr-from-bus"}), 2);
  EXPECT_TRUE(support::has_line(output_, {"--snr-from-bus", "only", "--simulation", "not", "--hear"})) << output_;
  EXPECT_EQ(check({mission, "--simulation", "3", "--hear", "--snr-from-bus"}), 2);
  EXPECT_TRUE(support::has_line(output_, {"--snr-from-bus", "only", "--simulation", "not", "--hear"})) << output_;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(CheckRun, RefusesAChartWithoutACheckAndACheckInSimulation) {
  EXPECT_EQ(check({(kMissions / "search.toml").string(), "--chart", (folder_ / "chart.svg").string()}), 2);
  EXPECT_NE(output_.find("--chart: only with --check"), std::string::npos) << output_;
  EXPECT_EQ(check({"--check", (kMissions / "search.toml").string(), "--simulation", "3"}), 2);
  EXPECT_NE(output_.find("--check: not with --simulation"), std::string::npos) << output_;
}

}  // namespace
}  // namespace earshot::board
