// What becomes of a vehicle at sea by what its safety record says, or no longer says: who has it hangs, it is removed, cut, another's, or
// the program was stopped before the vehicle was up.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "tests/firmware/host/file/killed_holder.hpp"
#include "tests/outage/restart_at_sea.hpp"

namespace earshot {
namespace {

namespace fs = std::filesystem;
using messages::MissionState;
using messages::Order;

constexpr const char* kRecords[]{"journal.safety", "journal.copy.safety"};

class RecordAtSea : public RestartAtSea {
 protected:
  /// GIVEN a search that was killed, and copies of its journal and records in another folder.
  fs::path search_carried_elsewhere() {
    search();
    kill();
    fs::path elsewhere = folder_ / "elsewhere";
    fs::create_directory(elsewhere);
    fs::copy_file(journal(), elsewhere / "journal.lcmlog");
    for (const char* name : kRecords) fs::copy_file(folder_ / name, elsewhere / name);
    return elsewhere;
  }
  void expect_no_setpoint_of_a_start_in(const fs::path& folder) {
    const int setpoints = vehicle_->setpoints;
    const int turns = vehicle_->turns;
    start_in(folder);
    ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > turns + 10; })) << earshotd_->output();
    EXPECT_EQ(vehicle_->setpoints, setpoints);
  }
};

TEST_F(RecordAtSea, GivenAStopBelowTheNextStartBringsTheVehicleUpAndAfterThatNothingIsUnderWay) {
  search();
  stop();
  EXPECT_TRUE(is_printed("it stays under way")) << earshotd_->output();
  start();
  expect_comes_up();
  stop();
  EXPECT_FALSE(is_printed("it stays under way")) << "its depth says that it is up" << earshotd_->output();
  const int turns = vehicle_->turns;
  start();
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > turns + 5; })) << earshotd_->output();
  EXPECT_EQ(vehicle_->state(), MissionState::kStandby) << earshotd_->output();
}

TEST_F(RecordAtSea, GivenAStopBelowAStartWithoutResumeStatesThatTheVehicleMayStillBeBelow) {
  search();
  stop();
  start_earshotd({"--speed", "10"});
  ASSERT_TRUE(vehicle_->sails_until([&] { return is_printed("For another rehearsal name another folder (--out)"); }))
      << earshotd_->output();
  EXPECT_TRUE(
      is_printed("warning: the earlier mission of this folder is over, but its vehicle was not known to be up, and may still be below. "
                 "It is given up: nobody commands the vehicle until START. With --resume earshotd brings it up."))
      << earshotd_->output();
  kill();
}

TEST_F(RecordAtSea, GivenALeakWhileTheJournalIsReadTheWeightStaysReleased) {
  std::ofstream(folder_ / "mission.toml", std::ios::app) << "\n[[rule]]\nwhen = \"leak\"\nfor_s = 1.0\nthen = \"release\"\n";
  search();
  kill();
  start_with_slow_reading();
  vehicle_->leak();
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->is_released; })) << earshotd_->output();
  EXPECT_FALSE(is_printed("goes on from"));
  vehicle_->leak(false);
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->state() == MissionState::kAbort; })) << earshotd_->output();
  const int setpoints = vehicle_->setpoints;
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->setpoints > setpoints + 5; })) << earshotd_->output();
  EXPECT_TRUE(vehicle_->is_released) << earshotd_->output();
  EXPECT_EQ(vehicle_->depth(), Meters{0});
}

TEST_F(RecordAtSea, GivenThatItsRecordIsRemovedItGoesOnByTheSecondOne) {
  search();
  kill();
  ASSERT_TRUE(fs::remove(folder_ / "journal.safety"));
  start();
  EXPECT_TRUE(vehicle_->sails_until([&] { return is_printed("goes on from") && vehicle_->turns > 5; })) << earshotd_->output();
  EXPECT_TRUE(fs::exists(folder_ / "journal.safety")) << "made anew";
}

TEST_F(RecordAtSea, GivenRecordsThatAreRemovedInFlightAnAbortHolds) {
  search();
  fs::remove(folder_ / "journal.safety");
  fs::remove(folder_ / "journal.copy.safety");
  vehicle_->order(Order::kAbort);
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->outcome.has_value(); })) << earshotd_->output();
  EXPECT_EQ(vehicle_->outcome, messages::CommandOutcome::kObeyed);
  kill();
  start();
  expect_comes_up();
}

TEST_F(RecordAtSea, GivenRecordsThatAreCutInFlightAndNoMissionItComesUp) {
  search();
  for (const char* name : kRecords) fs::resize_file(folder_ / name, 0);
  vehicle_->order(Order::kPause);
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->outcome.has_value(); })) << earshotd_->output();
  kill();
  fs::remove(folder_ / "mission.toml");
  start();
  expect_comes_up();
}

TEST_F(RecordAtSea, GivenThatNothingIsKeptOfTheVehicleItComesUpByLcmsDefaultAddress) {
  search();
  kill();
  for (const char* name : kRecords) fs::resize_file(folder_ / name, 8192);
  fs::remove(folder_ / "mission.toml");
  start();
  expect_comes_up();
}

TEST_F(RecordAtSea, GivenThatEveryRecordIsDamagedItComesUpIfItsJournalSaysThatASearchWasUnderWay) {
  search();
  kill();
  for (const char* name : kRecords)
    std::fstream(folder_ / name, std::ios::in | std::ios::out | std::ios::binary) << std::string(8192, '\0');
  start();
  expect_comes_up();
  EXPECT_TRUE(is_printed("every copy of its safety record is damaged")) << earshotd_->output();
  kill();
  start();
  expect_comes_up();
}

TEST_F(RecordAtSea, GivenRecordsThatOthersMayChangeItComesUpIfItsJournalSaysThatASearchWasUnderWay) {
  search();
  kill();
  for (const char* name : kRecords) fs::permissions(folder_ / name, fs::perms::group_write, fs::perm_options::add);
  start();
  expect_comes_up();
}

TEST_F(RecordAtSea, GivenFoldersLinksOrPipesInPlaceOfItsRecordsItComesUpIfItsJournalSaysThatASearchWasUnderWay) {
  search();
  kill();
  for (const auto& make :
       {+[](const fs::path& path) { fs::create_directory(path); }, +[](const fs::path& path) { fs::create_symlink(path, path); },
        +[](const fs::path& path) { ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0); }}) {
    for (const char* name : kRecords) {
      fs::remove_all(folder_ / name);
      make(folder_ / name);
    }
    start();
    expect_comes_up();
    kill();
  }
}

TEST_F(RecordAtSea, GivenAnOthersRecordsThatAnybodyMayChangeItCommandsNothing) {
  const fs::path elsewhere = search_carried_elsewhere();
  for (const char* name : kRecords) fs::permissions(elsewhere / name, fs::perms::group_write, fs::perm_options::add);
  expect_no_setpoint_of_a_start_in(elsewhere);
}

TEST_F(RecordAtSea, GivenNeitherRecordNorJournalThatCanBeReadItsStatusIsOneThatAServiceStartsAgain) {
  search();
  kill();
  for (const char* name : {"journal.safety", "journal.copy.safety", "journal.lcmlog"}) {
    fs::remove_all(folder_ / name);
    fs::create_symlink(folder_ / name, folder_ / name);
  }
  fs::remove(folder_ / "walk.policy");
  start();
  EXPECT_EQ(earshotd_->wait(std::chrono::seconds(10)), program::kLost) << earshotd_->output();
}

TEST_F(RecordAtSea, GivenThatEveryRecordIsDamagedInStandbyANewMissionBegins) {
  start();
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > 5; })) << earshotd_->output();
  kill();
  for (const char* name : kRecords) fs::resize_file(folder_ / name, 0);
  start();
  ASSERT_TRUE(vehicle_->sails_until([&] { return is_printed("journal-2.lcmlog") && vehicle_->turns > 15; })) << earshotd_->output();
  EXPECT_EQ(vehicle_->state(), MissionState::kStandby);
  EXPECT_EQ(vehicle_->setpoints, 0);
}

TEST_F(RecordAtSea, GivenAJournalThatWasFlownElsewhereWithItsRecordItBeginsInStandbyAndCommandsNothing) {
  const fs::path elsewhere = search_carried_elsewhere();
  expect_no_setpoint_of_a_start_in(elsewhere);
  EXPECT_EQ(vehicle_->state(), MissionState::kStandby);
  EXPECT_TRUE(is_printed("it is of another vehicle, or of another folder's flights")) << earshotd_->output();
}

TEST_F(RecordAtSea, GivenABackupThatHasLockedTheRecordToReadItTheMissionGoesOn) {
  search();
  kill();
  const host::FileDescriptor backup(::open((folder_ / "journal.safety").c_str(), O_RDONLY | O_CLOEXEC));
  ASSERT_EQ(::flock(backup.number(), LOCK_EX | LOCK_NB), 0) << "by another program's name";
  start();
  EXPECT_TRUE(vehicle_->sails_until([&] { return is_printed("goes on from") && vehicle_->turns > 5; })) << earshotd_->output();
}

TEST_F(RecordAtSea, GivenAKilledProgramWhoseRecordIsNotLetGoTheNextComesUpAtOnce) {
  search();
  kill();
  const support::KilledHolder holder(folder_ / "journal.safety", "earshotd");
  start();
  expect_comes_up();
  EXPECT_TRUE(
      is_printed("earshotd (process " + holder.number() + ") is writing this file, but has been killed, and does not end: a disk hangs"))
      << earshotd_->output();
}

TEST_F(RecordAtSea, GivenAFirstProgramThatHangsTheNextComesUpAndTheFirstEndsOnceItWakes) {
  search();
  const std::unique_ptr<support::Process> first = std::move(earshotd_);
  first->signal(SIGSTOP);
  vehicle_->health = {};
  const auto starts_again = [&] {
    if (earshotd_ == nullptr || earshotd_->wait(std::chrono::milliseconds(0)) == program::kLost) start();
    return vehicle_->state() == MissionState::kAbort && vehicle_->depth() == Meters{0.0};
  };
  EXPECT_TRUE(vehicle_->sails_until(starts_again)) << earshotd_->output();
  EXPECT_TRUE(is_printed("it hangs, or does not fly")) << earshotd_->output();
  first->signal(SIGCONT);
  EXPECT_EQ(first->wait(std::chrono::seconds(20)), program::kLost) << first->output();
  const int setpoints = vehicle_->setpoints;
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->setpoints > setpoints + 5; })) << earshotd_->output();
  EXPECT_EQ(vehicle_->depth(), Meters{0.0});
}

TEST_F(RecordAtSea, GivenAFlightUnderWayASecondProgramWithItsFolderIsRefusedAndTriedAgain) {
  search();
  const std::unique_ptr<support::Process> first = std::move(earshotd_);
  start();
  EXPECT_EQ(earshotd_->wait(std::chrono::seconds(10)), program::kLost) << earshotd_->output();
  const int turns = vehicle_->turns;
  const int setpoints = vehicle_->setpoints;
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > turns + 5 && vehicle_->setpoints > setpoints; })) << first->output();
}

}  // namespace
}  // namespace earshot
