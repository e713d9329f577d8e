#include "firmware/desk/journal_view/export/turn_table.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/firmware/desk/journal_view/export/export_rig.hpp"
#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::journal {
namespace {

std::vector<std::string> rows_of_known_journal(const std::optional<n2k::LocalPlane>& plane) {
  const support::TemporaryFolder folder;
  write_known_journal(folder / "journal");
  TurnTable table(folder / "turns.csv", plane);
  export_all(folder / "journal", table);
  EXPECT_EQ(table.what(), "4 turns");
  std::istringstream text(text_of(folder / "turns.csv"));
  std::vector<std::string> rows;
  for (std::string row; std::getline(text, row);) rows.push_back(row);
  return rows;
}

// The fix of turn 2 is 0.2 s old, its SNR 0.3 s; the fix that came before turn 3 has no place and does not count.
TEST(TurnTable, HasARowForEachTurnWithTheNewestThatIsKnown) {
  const std::vector<std::string> rows = rows_of_known_journal(std::nullopt);
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[0],
            "turn,time_s,mission_s,utc,state,steps_taken,response,navigation_age_s,north_m,east_m,latitude_deg,longitude_deg,depth_m,"
            "heading_deg,speed_mps,snr_age_s,snr_db,snr_too_faint,setpoint_heading_deg,setpoint_speed_mps,setpoint_depth_m,"
            "waypoint_north_m,waypoint_east_m,altitude_m,battery_percent,surprise_bits,sweeping,found,release_weight,"
            "leak,ground_fault,"
            "decisions,authority,paused,end_reason,navigation_refused,snr_refused,commands_refused,setpoints_limited,status_refused,"
            "bearings_refused,bearings_of_others,vehicle_status_age_s");
  EXPECT_EQ(rows[1],
            "1,1795359841.000000,1.000000,2026-11-22 15:04:01 "
            "UTC,STANDBY,0,warn,,,,,,,,,,,,,,,,,,,0.00,0,0,,,,0,standby,0,under_way,0,0,0,0,0,0,0,");
  EXPECT_EQ(rows[2],
            "2,1795359842.000000,2.000000,2026-11-22 15:04:02 UTC,SEARCH,0,warn,0.200000,1000.000,2000.000,,,299.500,30.000,1.750,"
            "0.300000,12.25,0,270.000,2.000,300.000,1000.000,1000.000,,80.50,0.00,0,0,0,0,0,0,standby,0,under_way,0,0,0,0,0,0,0,0.060000");
  EXPECT_EQ(rows[3],
            "3,1795359843.000000,3.000000,2026-11-22 15:04:03 UTC,SEARCH,0,warn,1.200000,1000.000,2000.000,,,299.500,30.000,1.750,"
            "1.300000,12.25,0,,,,,,,80.50,0.00,0,0,,0,0,0,standby,0,under_way,0,0,0,0,0,0,0,1.060000");
  EXPECT_EQ(rows[4].substr(0, 67), "4,1795359844.000000,4.000000,2026-11-22 15:04:04 UTC,ABORT,1,warn,2");
}

// 1000 m and 2000 m from 0 N 10 E on the WGS-84 ellipsoid: 110574.27 and 111319.49 m a degree.
TEST(TurnTable, SaysLatitudeAndLongitudeWhereTheOriginIsKnown) {
  const std::vector<std::string> rows = rows_of_known_journal(n2k::LocalPlane::about({.latitude_deg = 0.0, .longitude_deg = 10.0}).value());
  EXPECT_NE(rows[2].find(",2000.000,0.0090437,10.0179663,299.500,"), std::string::npos) << rows[2];
}

TEST(TurnTable, SaysOfEachTurnTheMismatchWhetherItSweepsAndWhetherItDeclares) {
  const support::TemporaryFolder folder;
  {
    WrittenJournal journal(folder / "journal");
    messages::Health health;
    health.state = messages::MissionState::kSearch;
    health.mismatch_bits = 13.5F;
    health.is_sweeping = true;
    journal.message(after(1000), wire::kHealthChannel, health);
    health.mismatch_bits = -2.0F;
    health.is_sweeping = false;
    health.is_found = true;
    journal.message(after(2000), wire::kHealthChannel, health);
    journal.close();
  }
  TurnTable table(folder / "turns.csv", std::nullopt);
  export_all(folder / "journal", table);
  const std::string text = text_of(folder / "turns.csv");
  EXPECT_NE(text.find(",13.50,1,0,,,,0,"), std::string::npos) << text;
  EXPECT_NE(text.find(",-2.00,0,1,,,,0,"), std::string::npos) << text;
}

TEST(TurnTable, HasAsManyCellsInEveryRowAsInItsHeader) {
  for (const std::string& row : rows_of_known_journal(std::nullopt)) EXPECT_EQ(std::ranges::count(row, ','), 42) << row;
}

}  // namespace
}  // namespace earshot::journal
