// How the two halves of a flight find each other, and what they say while they wait.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <unistd.h>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "sim/link/run_slot.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

const fs::path kSource = EARSHOT_SOURCE_DIR;
const fs::path kBin = EARSHOT_BIN_DIR;
const fs::path kMission = kSource / "firmware/boards/linux/missions/fixed_source.toml";

class Meeting : public testing::Test {
 protected:
  Meeting() {
    support::write_bytes(folder_ / "walk.policy", support::signed_bytes(support::random_walk_policy()));
    support::write_public_key(folder_ / "walk.pub");
  }

  [[nodiscard]] std::unique_ptr<support::Process> earshotd(const std::vector<std::string>& more) const {
    std::vector<std::string> a{kMission, "--policy",     folder_ / "walk.policy", "--public-key", folder_ / "walk.pub",
                               "--out",  folder_ / "out"};
    a.insert(a.end(), more.begin(), more.end());
    return std::make_unique<support::Process>(kBin / "earshotd", a, folder_ / "earshotd.txt");
  }

  /// Until the program has said `words`.
  [[nodiscard]] static bool says(support::Process& program, const std::string& words) {
    for (const auto deadline = std::chrono::steady_clock::now() + 30s; std::chrono::steady_clock::now() < deadline;) {
      if (program.output().find(words) != std::string::npos) return true;
      if (program.wait(10ms) >= 0) return program.output().find(words) != std::string::npos;
    }
    return false;
  }

  const support::TemporaryFolder folder_;
  const link::RunSlot slot_;
};

TEST_F(Meeting, GivenNoSimulatorEarshotdSaysWhomItWaitsForAndGivesUpWhenItSaidItWould) {
  const std::string domain = std::to_string(slot_.domain());
  fs::create_directories(folder_ / "out");
  std::ofstream(folder_ / "out/journal.lcmlog") << "an earlier flight";
  const auto runtime = earshotd({"--simulation", domain, "--lcm-url", slot_.lcm_url(), "--wait", "2", "--replace"});
  EXPECT_EQ(runtime->wait(20s), 3);
  EXPECT_TRUE(support::lines_tell(runtime->output(),
                                  {{"earshotd", "DDS", domain, "2 s", "at most"}, {"earshotd", "DDS", domain, "not come", "within 2 s"}}));
  EXPECT_EQ(support::read_text(folder_ / "out/journal.lcmlog"), "an earlier flight");
}

TEST_F(Meeting, GivenQuietEarshotdWaitsWithoutAWordAndSaysOnlyThatItWasInVain) {
  const std::string domain = std::to_string(slot_.domain());
  const auto runtime = earshotd({"--simulation", domain, "--lcm-url", slot_.lcm_url(), "--wait", "2", "--quiet"});
  EXPECT_EQ(runtime->wait(20s), 3);
  EXPECT_EQ(runtime->output(), "earshotd: a simulator in DDS domain " + domain + " did not come within 2 s\n");
}

TEST_F(Meeting, GivenSigtermWhileItWaitsEarshotdEndsAtOnceAndHasWrittenNothing) {
  const auto runtime = earshotd({"--simulation", std::to_string(slot_.domain()), "--lcm-url", slot_.lcm_url()});
  ASSERT_TRUE(says(*runtime, ", 60 s at most")) << runtime->output();
  runtime->signal(SIGTERM);
  EXPECT_EQ(runtime->wait(5s), 130) << runtime->output();
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Meeting, GivenNobodyOnItsBusAtSeaEarshotdSaysWhatItWaitsFor) {
  const std::string url = "udpm://239.255.76.67:" + std::to_string(22'000 + slot_.domain()) + "?ttl=0";
  const auto runtime = earshotd({"--lcm-url", url});
  EXPECT_TRUE(says(
      *runtime, "waiting for navigation, SNR and an operator's START, as long as it takes, on\n  port 1: vehicle, LCM " + url + " on lo"))
      << runtime->output();
  runtime->signal(SIGTERM);
  EXPECT_EQ(runtime->wait(5s), 0);
}

TEST_F(Meeting, GivenFilesInItsFolderThatAreNotItsOwnEarshotdLeavesThem) {
  const std::string url = "udpm://239.255.76.67:" + std::to_string(22'000 + slot_.domain()) + "?ttl=0";
  fs::create_directories(folder_ / "out");
  std::ofstream(folder_ / "out/journal.policy") << "my notes";
  std::ofstream(folder_ / "out/journal.lcmlog") << "more notes";
  const auto refused = earshotd({"--lcm-url", url, "--replace"});
  EXPECT_EQ(refused->wait(5s), 2) << refused->output();
  EXPECT_TRUE(support::has_line(refused->output(), {"journal.lcmlog", "already", "not", "--out"})) << refused->output();
  EXPECT_EQ(support::read_text(folder_ / "out/journal.lcmlog"), "more notes");
  const auto runtime = earshotd({"--lcm-url", url});  // its journal is journal-2.lcmlog, its policy journal-2.policy
  ASSERT_TRUE(says(*runtime, "journal-2.lcmlog")) << runtime->output();
  runtime->signal(SIGTERM);
  EXPECT_EQ(runtime->wait(5s), 0);
  EXPECT_EQ(support::read_text(folder_ / "out/journal.policy"), "my notes");
}

TEST_F(Meeting, GivenAPipeWhereItsPolicyIsKeptEarshotdFliesAllTheSame) {
  const std::string url = "udpm://239.255.76.67:" + std::to_string(22'000 + slot_.domain()) + "?ttl=0";
  fs::create_directories(folder_ / "out");
  ASSERT_EQ(mkfifo((folder_ / "out/journal.policy").c_str(), 0600), 0);
  const auto runtime = earshotd({"--lcm-url", url});
  EXPECT_TRUE(says(*runtime, "it is a pipe")) << runtime->output();
  EXPECT_TRUE(says(*runtime, "waiting for navigation")) << runtime->output();
  runtime->signal(SIGTERM);
  EXPECT_EQ(runtime->wait(5s), 0);
}

}  // namespace
}  // namespace earshot
