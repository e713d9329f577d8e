// What becomes of an earlier flight in the folder, whatever happens to a new one.

#include <gtest/gtest.h>

#include <unistd.h>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

const fs::path kSource = EARSHOT_SOURCE_DIR;
const fs::path kBin = EARSHOT_BIN_DIR;
const fs::path kEnvironment = kSource / "sim/ocean/environments/munk_flat.toml";
const fs::path kMission = kSource / "firmware/boards/linux/missions/search.toml";
constexpr const char* kUnfinished = "unfinished-flight";

/// Earlier flights, each file of which says so.
class Keeping : public testing::Test {
 protected:
  Keeping() {
    fs::create_directories(out_());
    for (const char* file : {"journal.lcmlog", "journal.policy", "journal.tables", "track.csv", "snr.csv", "summary.json", "report.html"})
      std::ofstream(out_() / file) << "earlier";
    earlier_ = files();
  }

  [[nodiscard]] fs::path out_() const { return folder_ / "out"; }

  [[nodiscard]] std::unique_ptr<support::Process> fly(const std::vector<std::string>& more, const fs::path& environment = kEnvironment,
                                                      const char* text = "text") const {
    std::vector<std::string> a{"--environment", environment, "--mission", kMission, "--out", out_()};
    a.insert(a.end(), more.begin(), more.end());
    return std::make_unique<support::Process>(kBin / "earshot-fly", a, folder_ / text);
  }

  /// The regular files of the folder itself.
  [[nodiscard]] std::map<fs::path, std::string> files() const {
    std::map<fs::path, std::string> all;
    for (const auto& entry : fs::directory_iterator(out_())) {
      if (entry.is_regular_file()) all[entry.path()] = support::read_text(entry.path());
    }
    return all;
  }

  /// Until a journal of some minutes at sea stands in the unfinished flight.
  [[nodiscard]] bool is_under_way(const support::Process& flight) const {
    const fs::path journal = out_() / kUnfinished / "journal.lcmlog";
    for (const auto deadline = std::chrono::steady_clock::now() + 30s; std::chrono::steady_clock::now() < deadline;) {
      std::error_code error;
      if (fs::exists(journal) && fs::file_size(journal, error) > 50'000) return true;
      std::this_thread::sleep_for(10ms);
    }
    ADD_FAILURE() << flight.output();
    return false;
  }

  /// The processes that were started to fly into the folder.
  [[nodiscard]] std::vector<pid_t> processes(const std::string& program) const {
    std::vector<pid_t> found;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string line = support::read_text(entry.path() / "cmdline");
      if (line.find("/" + program) != std::string::npos && line.find(out_().string()) != std::string::npos)
        found.push_back(std::stoi(entry.path().filename()));
    }
    return found;
  }
  [[nodiscard]] pid_t wait_for(const std::string& program) const {
    for (int i = 0; i < 2000; ++i) {
      if (const std::vector<pid_t> found = processes(program); !found.empty()) return found.front();
      std::this_thread::sleep_for(2ms);
    }
    return 0;
  }
  void expect_no_orphans() const {
    for (const char* program : {"earshotd", "earshot-sim"}) {
      for (int i = 0; i < 500 && !processes(program).empty(); ++i) std::this_thread::sleep_for(10ms);
      EXPECT_TRUE(processes(program).empty()) << program;
    }
  }

  const support::TemporaryFolder folder_;
  std::map<fs::path, std::string> earlier_;
};

TEST_F(Keeping, GivenADamagedPolicyTheEarlierFlightStaysAsItWas) {
  std::ofstream(folder_ / "cut.policy") << "abc";
  const auto flight = fly({"--policy", folder_ / "cut.policy"});
  EXPECT_EQ(flight->wait(20s), 2);
  EXPECT_EQ(flight->output(), (folder_ / "cut.policy").string() + ": is cut short\n");
  EXPECT_TRUE(files() == earlier_);
  EXPECT_FALSE(fs::exists(out_() / kUnfinished));
}

TEST_F(Keeping, GivenATruncatedFieldLibraryTheEarlierFlightStaysAsItWas) {
  const std::string whole = support::read_text(kEnvironment);
  std::ofstream(folder_ / "library.nc") << "CDF\x01";
  std::ofstream(folder_ / "sea.toml") << whole << "\n[field_library]\nfile = \"library.nc\"\n";
  const auto flight = fly({}, folder_ / "sea.toml");
  EXPECT_EQ(flight->wait(20s), 2) << flight->output();
  EXPECT_NE(flight->output().find("library.nc"), std::string::npos) << flight->output();
  EXPECT_TRUE(files() == earlier_);
  EXPECT_FALSE(fs::exists(out_() / kUnfinished));
}

TEST_F(Keeping, GivenAFlightUnderWayItIsKilledAndTheEarlierOneStaysBesideWhatIsUnfinished) {
  const auto flight = fly({"--speed", "2000", "--ignore-source"});
  ASSERT_TRUE(is_under_way(*flight));
  flight->signal(SIGKILL);
  EXPECT_EQ(flight->wait(5s), 128 + SIGKILL);
  expect_no_orphans();
  EXPECT_TRUE(files() == earlier_);
  EXPECT_TRUE(fs::exists(out_() / kUnfinished / "journal.lcmlog"));
}

TEST_F(Keeping, GivenAFlightUnderWayASecondOneIntoItsFolderIsRefusedAndToldWhoIsThere) {
  const auto first = fly({"--speed", "2000", "--ignore-source", "--no-report"});
  ASSERT_TRUE(is_under_way(*first));
  const auto second = fly({"--seed", "2"}, kEnvironment, "second");
  EXPECT_EQ(second->wait(20s), 2);
  EXPECT_NE(second->output().find("earshot-fly (process "), std::string::npos) << second->output();
  first->signal(SIGINT);
  EXPECT_EQ(first->wait(20s), 130) << first->output();
  EXPECT_EQ(nlohmann::json::parse(support::read_text(out_() / "summary.json")).at("seed"), 1);
  EXPECT_FALSE(fs::exists(out_() / kUnfinished));
}

TEST_F(Keeping, GivenNoReportCanBeWrittenTheStatusIsThreeAndTheEarlierFlightStays) {
  const fs::path programs = folder_ / "programs";
  fs::create_directories(programs);
  for (const char* program : {"earshot-fly", "earshotd", "earshot-sim", "libearshot-simulation.so"})
    fs::copy_file(kBin / program, programs / program);
  std::ofstream(programs / "earshot-report") << "#!/bin/sh\nexit 2\n";
  fs::permissions(programs / "earshot-report", fs::perms::owner_all);
  const std::vector<std::string> without_report{
      "EARSHOT_DATA=" + kSource.string(), programs / "earshot-fly", "--environment", kEnvironment, "--mission", kMission, "--out", out_()};
  support::Process flight("/usr/bin/env", without_report, folder_ / "text");
  EXPECT_EQ(flight.wait(60s), 3) << flight.output();
  EXPECT_NE(flight.output().find((out_() / kUnfinished).string()), std::string::npos) << flight.output();
  EXPECT_TRUE(files() == earlier_);
  EXPECT_TRUE(fs::exists(out_() / kUnfinished / "summary.json"));
}

TEST_F(Keeping, GivenItsRuntimeIsKilledBeforeTheFirstTickTheFlightEndsAtOnceAndSaysWhy) {
  const auto flight = fly({});
  const pid_t runtime = wait_for("earshotd");
  ASSERT_NE(runtime, 0);
  (void)kill(runtime, SIGKILL);
  EXPECT_EQ(flight->wait(5s), 3) << flight->output();
  EXPECT_TRUE(support::has_line(flight->output(), {"fly", "ended", "9"})) << flight->output();
  expect_no_orphans();
  EXPECT_TRUE(files() == earlier_);
}

TEST_F(Keeping, GivenSigtermAsSoonAsAnyOfItsProgramsIsThereTheFlightEndsAtOnceAndSaysSo) {
  for (const char* program : {"earshot-fly", "earshotd", "earshot-sim"}) {
    const auto flight = fly({"--speed", "1"});
    ASSERT_NE(wait_for(program), 0) << program << ": " << flight->output();
    flight->signal(SIGTERM);
    const int status = flight->wait(5s);
    EXPECT_TRUE(status == 130 || status == 128 + SIGTERM) << program << ": " << status;  // the second before main
    expect_no_orphans();
  }
  // Where the signal found the flight begun, that has ended in order and is whole.
  const std::string summary = support::read_text(out_() / "summary.json");
  EXPECT_TRUE(files() == earlier_ || summary.find("\"interrupted\"") != std::string::npos) << summary;
}

}  // namespace
}  // namespace earshot
