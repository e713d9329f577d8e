// What a flight tells the person who started it.

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/terminal.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

const fs::path kSource = EARSHOT_SOURCE_DIR;
const fs::path kFly = fs::path(EARSHOT_BIN_DIR) / "earshot-fly";
constexpr const char* kErased = "\r\033[K";

/// Without what the simulator says first where earshotd takes more than a moment to start, on a machine that tests share.
std::string without_waiting(const std::string& text) {
  return std::regex_replace(text, std::regex(R"(^earshot-sim: waiting for an earshotd[^\n]*\n)"), "");
}

class Talk : public testing::Test {
 protected:
  /// A flight with the shipped policy, which holds a belief; it finds the source within an hour.
  [[nodiscard]] std::vector<std::string> arguments(const std::vector<std::string>& more) const {
    std::vector<std::string> a{"--environment", kSource / "sim/ocean/environments/munk_flat.toml",
                               "--mission",     kSource / "firmware/boards/linux/missions/search.toml",
                               "--out",         folder_ / "out",
                               "--seed",        "3"};
    a.insert(a.end(), more.begin(), more.end());
    return a;
  }

  /// What it tells when nobody sits at a terminal.
  [[nodiscard]] std::string told(const std::vector<std::string>& more) const {
    support::Process flight(kFly, arguments(more), folder_ / "text");
    EXPECT_EQ(flight.wait(60s), 0) << flight.output();
    return without_waiting(flight.output());
  }

  const support::TemporaryFolder folder_;
};

/// So fast that the flight takes some seconds of a machine that could do it in a fraction of one.
const std::vector<std::string> kWatched{"--speed", "800"};

TEST_F(Talk, GivenATerminalALineTellsHowTheFlightGoesAndIsGoneBeforeTheSummary) {
  const support::Shown shown = support::shown_on_terminal(kFly, arguments(kWatched));
  EXPECT_EQ(shown.status, 0);
  const std::regex line(R"(\r[0-9]+ (s|min) at sea, step [1-9] of 100, SNR [0-9]+\.[0-9] dB, source believed [0-9]+\.[0-9] km away)");
  EXPECT_TRUE(std::regex_search(shown.text, line)) << shown.text;
  const std::size_t summary = shown.text.find("Source found after ");
  ASSERT_NE(summary, std::string::npos) << shown.text;
  const std::string before = without_waiting(shown.text.substr(0, summary));
  EXPECT_EQ(before.substr(before.size() - 4), kErased) << shown.text;
  EXPECT_EQ(before.find('\n'), std::string::npos) << "it stays on one line: " << shown.text;
}

TEST_F(Talk, GivenATerminalAndQuietNothingIsShown) {
  const support::Shown shown = support::shown_on_terminal(kFly, arguments({"--speed", "800", "--quiet"}));
  EXPECT_EQ(shown.status, 0);
  EXPECT_EQ(shown.text, "");
  EXPECT_TRUE(fs::exists(folder_ / "out/report.html"));
}

TEST_F(Talk, GivenNoTerminalThereIsTheSummaryAloneHoweverLongTheFlightTakes) {
  const std::string printed_ = told(kWatched);
  EXPECT_EQ(printed_.find('\r'), std::string::npos) << printed_;
  EXPECT_EQ(printed_.find("Source found after "), 0) << printed_;
}

TEST_F(Talk, GivenVerboseItAlsoTellsWhatGoesIntoTheFlight) {
  const std::string printed_ = told({"--verbose"});
  EXPECT_NE(printed_.find("--seed 3\n"), std::string::npos) << printed_;
  EXPECT_NE(printed_.find("--speed 0 (default)\n"), std::string::npos) << printed_;
  EXPECT_NE(printed_.find("Source found after "), std::string::npos) << printed_;
}

TEST_F(Talk, GivenAPolicyTrainedForAFixedSourceItWarnsBeforeItLooksForAnother) {
  const std::string policy = kSource / "policy/frozen/fixed_source.policy";
  const std::vector<std::string> fixed{"--policy", policy, "--no-report", "--mission",
                                       kSource / "firmware/boards/linux/missions/fixed_source.toml"};
  const auto flown = [&](const std::string& source) {
    std::vector<std::string> a{"--environment", kSource / "sim/ocean/environments/munk_flat.toml", "--out", folder_ / "out", "--source",
                               source};
    a.insert(a.end(), fixed.begin(), fixed.end());
    support::Process flight(kFly, a, folder_ / "text");
    EXPECT_EQ(flight.wait(60s), 0) << flight.output();
    return flight.output();
  };
  const std::string warning = "earshot fly: warning: " + policy + " was trained with a fixed source; use --source fixed\n";
  EXPECT_NE(flown("changing").find(warning), std::string::npos);
  EXPECT_EQ(flown("fixed").find("warning"), std::string::npos);
}

TEST_F(Talk, GivenASourceOfAnotherFrequencyThanTheMissionListensForItWarnsAndFlies) {
  const std::string mission = kSource / "firmware/boards/linux/missions/search.toml";
  const std::string ocean = kSource / "policy/worlds/oceans/hz_35.toml";
  support::Process flight(kFly, {"--environment", ocean, "--mission", mission, "--out", folder_ / "out", "--no-report"}, folder_ / "text");
  EXPECT_EQ(flight.wait(60s), 0) << flight.output();
  EXPECT_TRUE(support::has_line(flight.output(), {"fly", "warning", mission, "search.source_frequency_hz", "20", ocean, "35", "Hz"}))
      << flight.output();
}

TEST_F(Talk, GivenTablesWithoutANameItSaysWhichOptionThatIs) {
  std::vector<std::string> a = arguments({"--tables", ""});
  support::Process refused(kFly, a, folder_ / "refused");
  EXPECT_EQ(refused.wait(10s), 2);
  EXPECT_TRUE(support::lines_tell(refused.output(), {{"fly", "--tables", "--help"}}));
}

TEST_F(Talk, GivenAFileForItsFolderItSaysSoInOneSentence) {
  const fs::path file = folder_ / "README.md";
  std::ofstream(file) << "ours\n";
  std::vector<std::string> a = arguments({});
  *std::ranges::find(a, (folder_ / "out").string()) = file;
  support::Process refused(kFly, a, folder_ / "refused");
  EXPECT_EQ(refused.wait(10s), 2);
  EXPECT_TRUE(support::lines_tell(refused.output(), {{file.string(), "cannot", "read", "written", "Not", "directory"}}));
}

}  // namespace
}  // namespace earshot
