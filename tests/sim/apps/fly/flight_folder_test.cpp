#include "sim/apps/fly/flight_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/journal/journal.hpp"
#include "tests/support/process.hpp"
#include "tests/support/small_disk.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::fly {
namespace {

namespace fs = std::filesystem;

class FlightFolderTest : public testing::Test {
 protected:
  static void write_flight(const fs::path& folder, const std::string& which, bool with_report) {
    fs::create_directories(folder);
    for (const char* name : {"journal.lcmlog", "journal.policy", "track.csv", "snr.csv", "summary.json"})
      std::ofstream(folder / name) << which;
    if (with_report) std::ofstream(folder / "report.html") << which;
  }

  [[nodiscard]] std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(out_)) {
      if (entry.is_regular_file()) all[fs::relative(entry.path(), out_)] = support::read_text(entry.path());
    }
    return all;
  }

  static std::map<std::string, std::string> five_of(const std::string& which) {
    return {{"journal.lcmlog", which}, {"journal.policy", which}, {"track.csv", which}, {"snr.csv", which}, {"summary.json", which}};
  }

  /// With which a flight is refused; empty: it is not.
  [[nodiscard]] std::string complaint() const {
    try {
      const FlightFolder folder(out_);
      return "";
    } catch (const host::BadInput& e) {
      return e.what();
    }
  }

  const support::TemporaryFolder root_;
  const fs::path out_ = root_ / "a/out";
};

TEST(FlightFolderOnASmallDisk, IsRefusedInOneLineWhereTheDiskIsFullAndNothingIsMade) {
  const auto disk = support::SmallDisk::make(1 << 20);
  if (!disk) GTEST_SKIP() << "no file system of its own here";
  const fs::path out = disk->path() / "a/out";
  std::ofstream(disk->path() / "fill") << std::string(800 * 1024, 'x');
  try {
    const FlightFolder folder(out);
    ADD_FAILURE();
  } catch (const host::BadInput& e) {
    EXPECT_TRUE(support::tells(e.what(), {out.string(), "full", "224 kB", "thousands", "--out"}));
  }
  EXPECT_FALSE(fs::exists(disk->path() / "a"));
  EXPECT_EQ(place_of_rest(disk->path()), "what there is of it is in " + disk->path().string());
  std::ofstream(disk->path() / "more") << std::string(100 * 1024, 'x');
  EXPECT_EQ(place_of_rest(disk->path()), "what there is of it is in " + disk->path().string() + ", and the disk is full");
  ASSERT_TRUE(disk->resize(3 << 20));
  EXPECT_NO_THROW(const FlightFolder folder(out));
}

TEST_F(FlightFolderTest, AWholeFlightReplacesAllFilesOfAnEarlierOneAndLeavesTheOthersAlone) {
  write_flight(out_, "earlier", true);
  std::ofstream(out_ / "notes.txt") << "mine";
  {
    FlightFolder folder(out_);
    write_flight(folder.unfinished(), "new", false);
    folder.keep();
  }
  std::map<std::string, std::string> expected = five_of("new");
  expected["notes.txt"] = "mine";
  EXPECT_EQ(files(), expected);
}

TEST_F(FlightFolderTest, OfAnEarlierFlightThatHeardNothingStaysThatTheNewOneDidNotHear) {
  write_flight(out_, "earlier", true);
  for (const char* name : {"journal.tables", "hearing.csv", "spectrogram.csv"}) std::ofstream(out_ / name) << "earlier";
  {
    FlightFolder folder(out_);
    write_flight(folder.unfinished(), "new", false);
    folder.keep();
  }
  EXPECT_EQ(files(), five_of("new"));
}

TEST_F(FlightFolderTest, AFlightThatIsNotKeptLeavesTheEarlierOneWholeAndStandsAside) {
  write_flight(out_, "earlier", true);
  {
    FlightFolder folder(out_);
    fs::create_directories(folder.unfinished());
    std::ofstream(folder.unfinished() / "journal.lcmlog") << "cut";
  }
  std::map<std::string, std::string> expected = five_of("earlier");
  expected["report.html"] = "earlier";
  expected["unfinished-flight/journal.lcmlog"] = "cut";
  EXPECT_EQ(files(), expected);
  EXPECT_EQ(FlightFolder(out_).unfinished(), out_ / "unfinished-flight-2");
}

TEST_F(FlightFolderTest, AnExchangeThatWasCutAtAnyFileIsMadeGoodByTheNextFlight) {
  for (const char* last_moved : {"", "journal.lcmlog", "journal.policy", "track.csv", "snr.csv", "report.html", "summary.json"}) {
    fs::remove_all(out_);
    write_flight(out_ / "finished-flight", "new", true);
    if (*last_moved == '\0') write_flight(out_, "earlier", true);
    for (const char* name : {"journal.lcmlog", "journal.policy", "track.csv", "snr.csv", "report.html", "summary.json"}) {
      if (*last_moved == '\0') break;
      fs::rename(out_ / "finished-flight" / name, out_ / name);
      if (std::string(name) == last_moved) break;
    }
    { const FlightFolder next(out_); }
    std::map<std::string, std::string> expected = five_of("new");
    expected["report.html"] = "new";
    EXPECT_EQ(files(), expected) << "cut after " << last_moved;
    EXPECT_FALSE(fs::exists(out_ / "finished-flight"));
  }
}

TEST_F(FlightFolderTest, LeavesNoFolderBehindWhenNobodyWroteIntoIt) {
  { const FlightFolder folder(out_); }
  EXPECT_TRUE(fs::is_empty(root_));
}

TEST_F(FlightFolderTest, IsRefusedWhereAJournalFromSeaLies) {
  write_flight(out_, "earlier", true);  // even beside what a flight left: somebody may have moved that one's journal away
  const auto journal_of = [this](Time began) -> void {
    fs::remove(out_ / "journal.lcmlog");
    host::Journal journal(out_ / "journal.lcmlog", {});
    ASSERT_EQ(journal.append(began, "MISSION", {}), Status::kOk);
  };
  journal_of(Time{1'800'000'000'000'000});
  const std::map<std::string, std::string> before = files();
  EXPECT_TRUE(support::tells(complaint(), {(out_ / "journal.lcmlog").string(), "no", "replaces", "--out"}));
  EXPECT_EQ(files(), before);
  journal_of(Time{});  // a simulator's clock
  EXPECT_EQ(complaint(), "");
}

TEST_F(FlightFolderTest, IsRefusedWhereFilesLieThatAreNoFlightsUnlessAnEarlierFlightIsAmongThem) {
  fs::create_directories(out_ / "seven");
  EXPECT_EQ(complaint(), "");
  std::ofstream(out_ / "mission.toml") << "mine";
  EXPECT_TRUE(support::tells(complaint(), {out_.string(), "mission.toml", "no", "flight", "--out"}));
  write_flight(out_, "earlier", true);
  EXPECT_EQ(complaint(), "");
}

TEST_F(FlightFolderTest, IsRefusedToASecondFlight) {
  const FlightFolder first(out_);
  EXPECT_THROW(FlightFolder second(out_), host::FolderInUse);
}

}  // namespace
}  // namespace earshot::fly
