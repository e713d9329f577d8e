#include "firmware/boards/linux/outage/lost_record.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>

#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::board {
namespace {

using messages::MissionState;

class LostRecord : public testing::Test {
 protected:
  const support::TemporaryFolder folder;
  const std::filesystem::path path = folder / "journal.lcmlog";
};

/// Of a vehicle that needs 1.5 m/s to come up.
messages::MissionRecord mission() {
  messages::MissionRecord record = journal::known_mission();
  record.mission.safety.vehicle.ascent_speed = MetersPerSecond{1.5};
  return record;
}

TEST_F(LostRecord, OfASearchUnderWayIsMadeOfItsJournal) {
  {
    journal::WrittenJournal written(path);
    written.message(journal::after(0), wire::kMissionChannel, mission());
    written.bytes(journal::after(0), wire::kPolicyChannel, journal::kPolicy);
    written.health(journal::after(1000), 1, MissionState::kStandby);
    written.message(journal::after(2000), wire::kJournalledSetpointChannel, journal::some_setpoint());
    written.health(journal::after(2000), 2, MissionState::kSearch);
  }
  const std::optional<host::SafetyRecord> record = record_by_journal(path);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->state, MissionState::kSearch);
  EXPECT_TRUE(record->is_engaged);
  EXPECT_FALSE(record->is_released);
  EXPECT_EQ(record->mission_time, journal::after(2000));
  EXPECT_EQ(record->deepest, Meters{400});
  EXPECT_EQ(record->ascent_speed, MetersPerSecond{1.5});
}

TEST_F(LostRecord, IsNoneOfAJournalThatWasEndedInOrder) {
  journal::write_known_journal(path);
  EXPECT_FALSE(record_by_journal(path));
}

TEST_F(LostRecord, IsNoneOfAVehicleThatNobodyCommands) {
  {
    journal::WrittenJournal written(path);
    written.message(journal::after(0), wire::kMissionChannel, mission());
    written.health(journal::after(1000), 1, MissionState::kStandby);
  }
  EXPECT_FALSE(record_by_journal(path));
}

TEST_F(LostRecord, IsNoneWhereNoJournalCanBeRead) {
  EXPECT_FALSE(record_by_journal(path));
  std::ofstream(path) << "no journal at all";
  EXPECT_FALSE(record_by_journal(path));
}

}  // namespace
}  // namespace earshot::board
