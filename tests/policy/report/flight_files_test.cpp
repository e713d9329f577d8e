#include "policy/report/flight_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

TEST(LackOf, CountsByPriorityWhatTheClosingRecordSaysIsLost) {
  JournalledSearch journal;
  journal.missing = 6;
  journal.first_missing = 3;
  journal.closing.emplace().lost = {.streams = 3, .steering = 2, .orders = 1};
  EXPECT_TRUE(
      support::tells(lack_of(journal), {"6 records", "number 3", "on", "too", "Lost", "3", "SNR", "2 set-points", "1 orders", "changes"}));
}

TEST(ReadFlight, NamesTheKeyOfASummaryThatCannotBe) {
  const support::TemporaryFolder folder;
  const auto policy = explain::belief_policy(1);
  write_flight(folder, *policy, explain::flown(*policy, 1, {}), {});
  const auto complaint = [&](const std::string& summary) {
    std::ofstream(folder / "summary.json") << summary;
    try {
      (void)read_flight(folder);
    } catch (const host::BadInput& e) {
      return std::string(e.what()).substr((folder / "summary.json").string().size());
    }
    return std::string();
  };
  EXPECT_TRUE(support::tells(complaint("{\"found\": true, \"steps\": \"ten\"}"), {"steps", "0 to 1000000000"}));
  EXPECT_EQ(complaint("[]"), ": the whole: must be a table");
  EXPECT_TRUE(support::tells(complaint("{\"found\": "), {"not JSON", "11", "cut"}));
}

TEST(ReadFlight, RefusesNumbersOfASummaryThatNoFlightHasAndATrackWithoutRows) {
  const support::TemporaryFolder folder;
  const auto policy = explain::belief_policy(1);
  write_flight(folder, *policy, explain::flown(*policy, 1, {}), {});
  const auto refusal = [&] {
    try {
      (void)read_flight(folder);
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
  std::ofstream(folder / "track.csv") << "time_s,north_m\n";
  EXPECT_TRUE(support::tells(refusal(), {"track.csv", "0 rows", "at least 1"}));
}

TEST(PlaceIn, IsNorthAndEast) {
  EXPECT_EQ(place_in(nlohmann::json::parse(R"({"north_m": 12.5, "east_m": -3.0})")), (NorthEast{Meters{12.5}, Meters{-3.0}}));
}

}  // namespace
}  // namespace earshot::report
