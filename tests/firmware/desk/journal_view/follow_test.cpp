// GIVEN a mission that is under way, or one that is to come, WHEN its journal is followed, THEN it is told as it happens.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/firmware/desk/journal_view/journal_program.hpp"
#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::journal {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// A mission that is under way while earshot journal follows it.
class JournalFollowed : public ::testing::Test {
 protected:
  /// Waits, for as long as it takes but not for ever, until this was said.
  [[nodiscard]] bool hears(const std::string& text) const {
    for (int i = 0; i < 600; ++i, std::this_thread::sleep_for(50ms))
      if (process_.output().find(text) != std::string::npos) return true;
    return false;
  }
  static fs::path begun(const fs::path& path, WrittenJournal& journal) {
    journal.message(kBegan, wire::kMissionChannel, known_mission());
    journal.flush();
    return path;
  }

  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "journal.lcmlog";
  WrittenJournal journal_{path_};
  support::Process process_{kProgram, {begun(path_, journal_).string(), "--follow"}, folder_ / "said.txt"};
};

TEST_F(JournalFollowed, SaysWhatHappensAsItIsWrittenUntilTheMissionEnds) {
  EXPECT_TRUE(hears("mission begins"));
  journal_.health(after(1000), 1, messages::MissionState::kSearch);
  journal_.flush();
  EXPECT_TRUE(hears("1.0 s  SEARCH\n")) << process_.output();
  journal_.close({.time = after(2000), .ending = messages::Ending::kStopped});
  EXPECT_EQ(process_.wait(30s), 0);
  EXPECT_NE(process_.output().find("end: the program was stopped"), std::string::npos) << process_.output();
}

TEST_F(JournalFollowed, EndsOnCtrlC) {
  EXPECT_TRUE(hears("mission begins"));
  process_.signal(SIGINT);
  EXPECT_EQ(process_.wait(30s), 130);
}

TEST_F(JournalFollowed, EndsWhenTheProgramThatWroteIsGone) {
  journal_.close();  // without a closing record, as if it had been killed
  EXPECT_EQ(process_.wait(30s), 1);
  EXPECT_NE(process_.output().find("the journal's end is missing"), std::string::npos) << process_.output();
}

/// GIVEN a folder in which a flight was made, WHEN its journal is followed, THEN it is the next flight that is told of.
class FlightFollowed : public ::testing::Test {
 protected:
  FlightFollowed() {
    WrittenJournal old(path_);
    begin(old);
    old.health(Time{1'000'000}, 1, messages::MissionState::kSearch);
    old.close({.time = Time{2'000'000}, .ending = messages::Ending::kMissionOver});
  }
  static void begin(WrittenJournal& journal) {
    journal.message(Time{}, wire::kMissionChannel, known_mission());
    journal.flush();
  }
  void follow() {
    process_ = std::make_unique<support::Process>(kProgram, std::vector<std::string>{path_.string(), "--follow", wait_}, output_);
  }
  [[nodiscard]] bool hears(const std::string& text) const {
    for (int i = 0; i < 600; ++i, std::this_thread::sleep_for(50ms))
      if (process_->output().find(text) != std::string::npos) return true;
    return false;
  }
  [[nodiscard]] fs::path unfinished(const char* name) const {
    fs::create_directories(folder_ / name);
    return folder_ / name / "journal.lcmlog";
  }

  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "journal.lcmlog";
  const fs::path output_ = folder_ / "said.txt";
  std::string wait_ = "--wait=60";
  std::unique_ptr<support::Process> process_;
};

TEST_F(FlightFollowed, IsTheOneThatIsUnderWayThoughOneThatWasCutOffLiesBesideIt) {
  fs::copy_file(path_, unfinished("unfinished-flight"));
  WrittenJournal flight(unfinished("unfinished-flight-2"));
  begin(flight);
  follow();
  EXPECT_TRUE(hears("mission begins"));
  flight.health(Time{5'000'000}, 1, messages::MissionState::kSearch);
  flight.flush();
  EXPECT_TRUE(hears("5.0 s  SEARCH\n")) << process_->output();
  flight.close({.time = Time{6'000'000}, .ending = messages::Ending::kMissionOver});
  fs::rename(folder_ / "unfinished-flight-2/journal.lcmlog", path_);
  fs::remove(folder_ / "unfinished-flight-2");
  EXPECT_EQ(process_->wait(30s), 0);
  EXPECT_NE(process_->output().find("6.0 s  end: the mission was over"), std::string::npos) << process_->output();
  EXPECT_EQ(process_->output().find("1.0 s  SEARCH"), std::string::npos) << process_->output();
}

TEST_F(FlightFollowed, IsFoundInItsFolderWhateverItsNumberThere) {
  WrittenJournal third(folder_ / "journal-3.lcmlog");
  begin(third);
  process_ = std::make_unique<support::Process>(kProgram, std::vector<std::string>{folder_.path().string(), "--follow", wait_}, output_);
  EXPECT_TRUE(hears("follows " + (folder_ / "journal-3.lcmlog").string())) << process_->output();
  third.health(Time{5'000'000}, 1, messages::MissionState::kSearch);
  third.flush();
  EXPECT_TRUE(hears("5.0 s  SEARCH\n")) << process_->output();
  third.close({.time = Time{6'000'000}, .ending = messages::Ending::kMissionOver});
  EXPECT_EQ(process_->wait(30s), 0) << process_->output();
}

TEST_F(FlightFollowed, IsWaitedForWhereAnOlderOneLiesOrNone) {
  for (const bool is_old_there : {true, false}) {
    if (!is_old_there) fs::remove(path_);
    follow();
    EXPECT_TRUE(hears("earshot journal: waiting for a mission that writes " + path_.string())) << process_->output();
    WrittenJournal flight(unfinished("unfinished-flight"));
    begin(flight);
    EXPECT_TRUE(hears("mission begins"));
    flight.close({.time = Time{6'000'000}, .ending = messages::Ending::kMissionOver});
    EXPECT_EQ(process_->wait(30s), 0) << process_->output();
    EXPECT_EQ(process_->output().find("1.0 s  SEARCH"), std::string::npos) << process_->output();
    fs::remove_all(folder_ / "unfinished-flight");
  }
}

TEST_F(FlightFollowed, ThatDoesNotComeIsSaidAndNotReplacedByAnOlderOne) {
  wait_ = "--wait=1";
  follow();
  EXPECT_EQ(process_->wait(30s), 2);
  EXPECT_TRUE(support::has_line(process_->output(), {path_.string(), "flight", "no", "began", "without --follow"})) << process_->output();
  fs::remove(path_);
  follow();
  EXPECT_EQ(process_->wait(30s), 2);
  EXPECT_NE(process_->output().find(path_.string() + ": no such file; no mission began there"), std::string::npos) << process_->output();
}

}  // namespace
}  // namespace earshot::journal
