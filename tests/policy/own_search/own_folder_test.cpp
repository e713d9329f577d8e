#include "policy/own_search/own_folder.hpp"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::own_search {
namespace {

namespace fs = std::filesystem;

class OwnFolder : public testing::Test {
 protected:
  static std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
  }

  /// It is refused for `reason`, and nothing is another than before.
  void refuses(const OwnSearch& search, Earlier earlier, const std::string& reason) const {
    const auto before = names_in(parent_.path());
    try {
      make_own_folder(own_, search, earlier);
      ADD_FAILURE() << "made";
    } catch (const host::BadInput& e) {
      EXPECT_NE(std::string(e.what()).find(reason), std::string::npos) << e.what();
    }
    EXPECT_EQ(names_in(parent_.path()), before);
  }

  support::TemporaryFolder parent_;
  fs::path own_ = parent_.path() / "own";
};

const std::vector<std::string> kFour{"README.md", "mission.toml", "ocean.toml", "run"};
const OwnSearch kAnotherSize{.area_north_m = 10'000.0};

TEST_F(OwnFolder, HoldsFourFilesAndItsParentNothingElse) {
  make_own_folder(own_, {}, Earlier::kStays);
  EXPECT_EQ(names_in(own_), kFour);
  EXPECT_EQ(names_in(parent_.path()), std::vector<std::string>{"own"});
}

TEST_F(OwnFolder, FillsAnEmptyFolder) {
  fs::create_directory(own_);
  make_own_folder(own_, {}, Earlier::kStays);
  EXPECT_EQ(names_in(own_), kFour);
  EXPECT_EQ(names_in(parent_.path()), std::vector<std::string>{"own"});
}

TEST_F(OwnFolder, IsRefusedWhereThatWouldReplaceAnything) {
  make_own_folder(own_, {}, Earlier::kStays);
  refuses({}, Earlier::kStays, "--force replaces it");
  std::ofstream(own_ / "thesis.txt") << "mine";
  refuses({}, Earlier::kReplaced, "holds thesis.txt");
  EXPECT_EQ(support::read_text(own_ / "thesis.txt"), "mine");
}

TEST_F(OwnFolder, IsReplacedWholeWhenThatIsAskedFor) {
  make_own_folder(own_, kAnotherSize, Earlier::kStays);
  make_own_folder(own_, {.depth_m = 100.0}, Earlier::kReplaced);
  EXPECT_NE(support::read_text(own_ / "mission.toml").find("\ndepth_m = 100.0"), std::string::npos);
  EXPECT_FALSE(fs::exists(own_ / "search.policy"));
  EXPECT_EQ(names_in(parent_.path()), std::vector<std::string>{"own"});
}

/// What README.md there, and its `run`, lead to.
TEST_F(OwnFolder, KeepsItsFlightsAndJournalsWhenItIsReplaced) {
  make_own_folder(own_, {}, Earlier::kStays);
  const std::vector<std::string> left{"flight/journal.lcmlog",           "flight/report.html", "journal/journal-3.lcmlog",
                                      "out/unfinished-flight/track.csv", "journal-2.policy",   "journal.part2.lcmlog"};
  for (const std::string& file : left) {
    fs::create_directories((own_ / file).parent_path());
    std::ofstream(own_ / file) << file;
  }
  make_own_folder(own_, {.depth_m = 100.0}, Earlier::kReplaced);
  EXPECT_NE(support::read_text(own_ / "mission.toml").find("\ndepth_m = 100.0"), std::string::npos);
  for (const std::string& file : left) EXPECT_EQ(support::read_text(own_ / file), file);
  EXPECT_EQ(names_in(parent_.path()), std::vector<std::string>{"own"});
  fs::create_directory(own_ / "notes");
  refuses({}, Earlier::kReplaced, "holds notes, which is none of the files that earshot init makes, and no flight");
}

TEST_F(OwnFolder, KeepsItsKeyWhenItIsReplaced) {
  make_own_folder(own_, kAnotherSize, Earlier::kStays);
  const std::string key = support::read_text(own_ / "search.key");
  make_own_folder(own_, {.area_east_m = 8'000.0}, Earlier::kReplaced);
  EXPECT_EQ(support::read_text(own_ / "search.key"), key);
}

/// Tables of a folder's own may have taken hours to make.
TEST_F(OwnFolder, KeepsTablesOfItsOwnOrIsRefusedWhereTheyDoNotFit) {
  make_own_folder(own_, {.area_east_m = 8'000.0}, Earlier::kStays);  // with tables that init makes of those that ship, signed with its key
  const std::string tables = support::read_text(own_ / "search.tables");
  make_own_folder(own_, {.area_east_m = 8'000.0, .depth_m = 310.0, .own_tables = true}, Earlier::kReplaced);
  EXPECT_TRUE(support::read_text(own_ / "search.tables") == tables);
  refuses({.area_east_m = 8'000.0, .frequency_hz = 50.0}, Earlier::kReplaced, "move it elsewhere first");
  make_own_folder(own_, {}, Earlier::kReplaced);  // by what ships: they are not needed, but not lost
  EXPECT_TRUE(support::read_text(own_ / "search.tables") == tables);
}

TEST_F(OwnFolder, HoldsAllButTheTablesWhereNoneThatShipAreOfTheSearch) {
  EXPECT_EQ(make_own_folder(own_, {.depth_m = 200.0, .frequency_hz = 35.0}, Earlier::kStays), FliesBy::kTablesToBeMade);
  EXPECT_EQ(names_in(own_),
            (std::vector<std::string>{"README.md", "mission.toml", "ocean.toml", "run", "search.key", "search.policy", "search.pub"}));
  EXPECT_NE(support::read_text(own_ / "mission.toml").find("\ntables = \"search.tables\""), std::string::npos);
}

TEST_F(OwnFolder, IsRefusedWhereNoneCanBeMade) {
  try {
    make_own_folder("/proc/own", {}, Earlier::kStays);  // where nobody can make one, root neither
    ADD_FAILURE() << "made";
  } catch (const host::BadInput& e) {
    EXPECT_TRUE(support::tells(e.what(), {"own", "cannot", "made", "No"}));
  }
}

/// While it lives no file of this process grows beyond so many bytes: to a program that is as a disk that is full.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    EXPECT_EQ(::getrlimit(RLIMIT_FSIZE, &before_), 0);
    const rlimit small{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;
  ~SmallFiles() {
    (void)::setrlimit(RLIMIT_FSIZE, &before_);
    (void)std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(OwnFolder, LeavesNothingWhereAFileCannotBeWrittenWhole) {
  {
    const SmallFiles small(10'000);  // too few for tables, enough for all that is written before them
    EXPECT_ANY_THROW(make_own_folder(own_, kAnotherSize, Earlier::kStays));
  }
  EXPECT_EQ(names_in(parent_.path()), std::vector<std::string>{});
}

TEST_F(OwnFolder, LeavesNothingOfASearchThatWouldNotBeFlown) {
  refuses({.depth_m = 300.0, .sea_floor_m = 300.0}, Earlier::kStays, "--sea-floor-m");
  refuses({.speed_mps = 1e-9}, Earlier::kStays, "these options make a search that is refused: mission.toml:");
  refuses({.speed_mps = 10.0, .fence_m = 10.0}, Earlier::kStays, "these options make a search that is refused: mission.toml:");
}

// The band with its flanks, which reach 35 % above the frequency, must lie below 1 kHz, and its upper end not below 10 Hz.
TEST_F(OwnFolder, HearsEveryFrequencyThatItTakes) {
  for (const double frequency_hz : {kHeard_hz.lowest, 9.123, 12.345, 99.99, 739.9, kHeard_hz.highest}) {
    make_own_folder(own_, {.frequency_hz = frequency_hz, .hears = true}, Earlier::kStays);
    EXPECT_TRUE(fs::exists(own_ / "mission.toml")) << frequency_hz;
    fs::remove_all(own_);
  }
  const std::string range = "a hydrophone's detector is for 9.1 to 740.0 Hz";
  for (const double frequency_hz : {2.0, 9.0, 741.0, 899.0, 900.0})
    refuses({.frequency_hz = frequency_hz, .hears = true}, Earlier::kStays, range);
}

TEST_F(OwnFolder, HearsOnABusOfItsOwnWhateverTheVehiclesIs) {
  for (const char* const url : {"udpm://239.255.76.68:7668?ttl=0", "udpm://239.255.76.68:7668", "udpm://239.255.76.69:7669?ttl=1"})
    EXPECT_NO_THROW(make_own_folder(own_, {.lcm_url = url, .hears = true}, Earlier::kReplaced)) << url;
}

TEST_F(OwnFolder, IsRefusedInAFolderThatIsNotThereAndInPlaceOfAFile) {
  EXPECT_THROW(make_own_folder(own_ / "deep", {}, Earlier::kStays), host::BadInput);
  std::ofstream(own_.string()) << "a file";
  refuses({}, Earlier::kReplaced, "is no folder");
}

}  // namespace
}  // namespace earshot::own_search
