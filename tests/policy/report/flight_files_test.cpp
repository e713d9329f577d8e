#include "policy/report/flight_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/policy/report/sea/sea_journal.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

TEST(LackOf, CountsByPriorityWhatTheClosingRecordSaysIsLost) {
  JournalledSearch journal;
  journal.missing = 6;
  journal.first_missing = 3;
  journal.closing.emplace().lost = {.streams = 3, .steering = 2, .orders = 1};
  EXPECT_TRUE(
      support::tells(lack_of(journal), {"6 records", "number 3", "on", "too", "Lost", "3", "SNR", "2 set-points", "1 orders", "changes"}));
}

TEST(ReadFlightFiles, NamesTheKeyOfASummaryThatCannotBe) {
  const support::TemporaryFolder folder;
  const auto policy = explain::belief_policy(1);
  write_flight(folder, *policy, explain::flown(*policy, 1, {}), {});
  const auto complaint = [&](const std::string& summary) {
    std::ofstream(folder / "summary.json") << summary;
    try {
      (void)read_flight_files(folder);
    } catch (const host::BadInput& e) {
      return std::string(e.what()).substr((folder / "summary.json").string().size());
    }
    return std::string();
  };
  EXPECT_TRUE(support::tells(complaint("{\"found\": true, \"steps\": \"ten\"}"), {"steps", "0 to 1000000000"}));
  EXPECT_EQ(complaint("[]"), ": the whole: must be a table");
  EXPECT_TRUE(support::tells(complaint("{\"found\": "), {"not JSON", "11", "cut"}));
}

TEST(ReadFlightFiles, RefusesNumbersOfASummaryThatNoFlightHas) {
  const support::TemporaryFolder folder;
  const auto policy = explain::belief_policy(1);
  write_flight(folder, *policy, explain::flown(*policy, 1, {}), {});
  const auto refusal = [&] {
    try {
      (void)read_flight_files(folder);
    } catch (const host::BadInput& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(), "");
  const auto whole = nlohmann::json::parse(std::ifstream(folder / "summary.json"));
  const auto with = [&](const char* key, double number) {
    auto summary = whole;
    summary[key] = number;
    std::ofstream(folder / "summary.json") << summary;
    return refusal();
  };
  for (const char* key : {"distance_m", "sim_time_s", "wall_time_s", "depth_m", "speed_mps", "source_frequency_hz"})
    EXPECT_TRUE(support::tells(with(key, -1.0), {"summary.json", key, "from 0"}));
  EXPECT_TRUE(support::tells(with("battery_percent", 101.0), {"summary.json", "battery_percent", "0 to 100"}));
  EXPECT_EQ(with("reward", -1.0), "");
  std::ofstream(folder / "snr.csv") << "range_m,snr_db\n0,1\n";
  EXPECT_TRUE(support::tells(refusal(), {"snr.csv", "1 row", "at least 2"}));
}

TEST(PlaceIn, IsNorthAndEast) {
  EXPECT_EQ(place_in(nlohmann::json::parse(R"({"north_m": 12.5, "east_m": -3.0})")), (NorthEast{Meters{12.5}, Meters{-3.0}}));
}

constexpr std::uintmax_t kClosingBytes = 28 + 19 + 47;  ///< header, channel, journal_end_t: the last record

/// A simulated flight of three decisions.
class ReadJournal : public testing::Test {
 protected:
  ReadJournal() { write_flight(folder_, *policy_, explain::flown(*policy_, 3, {}), {}); }

  support::TemporaryFolder folder_;
  std::unique_ptr<policy::FrozenPolicy> policy_ = explain::belief_policy(1);
};

TEST_F(ReadJournal, RefusesASummaryWhoseOriginIsNoPlace) {
  nlohmann::json summary = read_flight_files(folder_).summary;
  summary["origin"] = {{"latitude_deg", "north"}, {"longitude_deg", 3.0}};
  std::ofstream(folder_ / "summary.json") << summary;
  try {
    (void)read_flight_files(folder_);
    FAIL() << "was taken";
  } catch (const host::BadInput& e) {
    EXPECT_EQ(e.what(), fs::path(folder_ / "summary.json").string() + ": origin: must be latitude_deg, longitude_deg");
  }
}

TEST_F(ReadJournal, SaysWhereTheJournalIsDamagedAndHowMuchOfItIsRead) {
  const fs::path journal = folder_ / "journal.lcmlog";
  const auto size = fs::file_size(journal);
  const auto of_decisions = size - kClosingBytes;
  ASSERT_EQ(of_decisions % 3, 0U) << "three decisions of one length";
  {
    std::fstream file(journal, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(of_decisions / 3 + 100));
    file.put('\x55');
  }
  const std::string said = "The journal is damaged: " + std::to_string(of_decisions / 3) + " bytes from byte " +
                           std::to_string(of_decisions / 3) +
                           " on are no record. What stands behind was read. The journal lacks 1 records from number 1 on: damaged, or the "
                           "disk was full or too slow.";
  EXPECT_EQ(read_journal(journal).decisions.size(), 2U);
  EXPECT_EQ(lack_of(read_journal(journal)), said);
}

TEST_F(ReadJournal, TellsACutJournalFromADamagedOne) {
  const fs::path journal = folder_ / "journal.lcmlog";
  EXPECT_EQ(lack_of(read_journal(journal)), "");
  const auto record = (fs::file_size(journal) - kClosingBytes) / 3;  // three decisions of one length
  fs::resize_file(journal, 3 * record - 1);
  const std::string said = lack_of(read_journal(journal));
  const std::string third = std::to_string(2 * record);
  EXPECT_TRUE(support::tells(said, {"journal", "ends", std::to_string(record - 1), third, std::to_string(3 * record - 1), "no", "record",
                                    "stopped", "before it", "2 records", "2 decisions"}));
}

TEST_F(ReadJournal, SaysFromWhichNumberOnAJournalLacksWhatAFullDiskDidNotTake) {
  const fs::path journal = folder_ / "journal.lcmlog";
  std::ifstream file(journal, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const std::size_t record = (bytes.size() - kClosingBytes) / 3;
  bytes.erase(record, record);  // the second of three decisions of one length
  std::ofstream(journal, std::ios::binary) << bytes;
  EXPECT_FALSE(read_journal(journal).is_whole());
  const std::string said = "The journal lacks 1 records from number 1 on: the disk was full or too slow.";
  EXPECT_EQ(lack_of(read_journal(journal)), said);
}

TEST_F(ReadJournal, SaysThatTheEndOfAJournalIsMissingThatWasNotEndedInOrder) {
  const fs::path journal = folder_ / "journal.lcmlog";
  EXPECT_TRUE(read_journal(journal).is_whole());
  fs::resize_file(journal, fs::file_size(journal) - kClosingBytes);  // as a kill leaves it
  EXPECT_FALSE(read_journal(journal).is_whole());
  const std::string said =
      "The journal's end is missing: no closing record stands behind its last record, for the runtime was killed, lost its power, met an "
      "error, or is of a version that wrote none.";
  EXPECT_EQ(lack_of(read_journal(journal)), said);
}

TEST(JournalOfFlight, IsTheNewestOfThoseThatFlightsAtSeaLeftInAFolder) {
  const support::TemporaryFolder folder;
  for (const char* name : {kJournalName, "journal-10.lcmlog", "journal-2.lcmlog"})
    SeaJournal(folder / name).end(messages::Ending::kStopped);
  EXPECT_EQ(journal_of_flight(folder.path()), folder / "journal-10.lcmlog");
  EXPECT_EQ(journal_of_flight(folder / "journal-2.lcmlog"), folder / "journal-2.lcmlog");
  EXPECT_EQ(read_flight_files(folder / "journal-2.lcmlog").missing, std::vector<std::string>{});
}

}  // namespace
}  // namespace earshot::report
