// What becomes of a vehicle whose earshotd was killed in mid-search and is started again, as its service does, when something is wrong by
// then: it goes on, or comes up, and what was ordered holds.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/transport/bus_lock.hpp"
#include "tests/outage/restart_at_sea.hpp"

namespace earshot {
namespace {

namespace fs = std::filesystem;
using messages::MissionState;
using messages::Order;

TEST_F(RestartAtSea, GivenNothingWrongItGoesOn) {
  search();
  kill();
  start();
  EXPECT_TRUE(vehicle_->sails_until([&] { return is_printed("goes on from") && vehicle_->turns > 5; })) << earshotd_->output();
  EXPECT_TRUE(is_printed(": SEARCH, after ")) << earshotd_->output();
}

class SickDiskRestart : public RestartAtSea, public testing::WithParamInterface<const char*> {
 protected:
  /// @param vehicle  what its computer has at every start
  void expect_abort_holds(const Environment& vehicle) {
    Environment sick = vehicle;
    sick.emplace_back("LD_PRELOAD", EARSHOT_SICK_DISK);
    sick.emplace_back("EARSHOT_TEST_DISK", GetParam());
    sick.emplace_back("EARSHOT_TEST_DISK_IS_SICK", folder_ / "sick");
    search(sick);
    std::ofstream(folder_ / "sick") << "";
    vehicle_->order(Order::kAbort);
    ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->state() == MissionState::kAbort; })) << earshotd_->output();
    kill();
    fs::remove(folder_ / "sick");
    start_with(vehicle);
    expect_comes_up();
  }
};

TEST_P(SickDiskRestart, AnAbortThatWasAcknowledgedHoldsThoughTheDiskTookNothingOfTheJournal) {
  expect_abort_holds({});
}

TEST_P(SickDiskRestart, AnAbortThatWasAcknowledgedHoldsByTheCopyInMemoryThoughTheDiskTookNothingOfTheRecordEither) {
  fs::create_directory(folder_ / "memory");
  expect_abort_holds({{"RUNTIME_DIRECTORY", folder_ / "memory"}, {"EARSHOT_TEST_DISK_HAS_RECORD", "1"}});
}

INSTANTIATE_TEST_SUITE_P(Disk, SickDiskRestart, testing::Values("full", "read-only", "slow"));

TEST_F(RestartAtSea, GivenABitThatFlippedInAnOlderRecordItComesUp) {
  search();
  kill();
  std::fstream file(journal(), std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(static_cast<std::streamoff>(fs::file_size(journal()) / 2));
  const int byte = file.get();
  file.seekp(-1, std::ios::cur);
  file.put(static_cast<char>(byte ^ 1));
  file.close();
  start();
  expect_comes_up();
}

TEST_F(RestartAtSea, GivenNoPolicyItComesUp) {
  search();
  kill();
  fs::remove(folder_ / "walk.policy");
  start();
  expect_comes_up();
}

TEST_F(RestartAtSea, GivenNoMissionItComesUp) {
  search();
  kill();
  fs::remove(folder_ / "mission.toml");
  start();
  expect_comes_up();
}

TEST_F(RestartAtSea, GivenNoJournalItComesUp) {
  search();
  kill();
  fs::remove(journal());
  start();
  expect_comes_up();
}

TEST_F(RestartAtSea, GivenABusThatAnotherHoldsItComesUp) {
  search();
  kill();
  const host::BusLock taken = host::lock_lcm(host::kDefaultLcmUrl);
  start();
  expect_comes_up();
}

TEST_F(RestartAtSea, GivenACommandLineThatItDoesNotKnowItComesUp) {
  search();
  kill();
  start({"--option-of-a-newer-unit"});
  expect_comes_up();
}

TEST_F(RestartAtSea, GivenOptionsThatDoNotGoTogetherItComesUp) {
  search();
  kill();
  start({"--replace"});
  expect_comes_up();
  EXPECT_TRUE(is_printed("--replace")) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenNoThreadThatCouldBeMadeItComesUpAndKeepsItsRecord) {
  search();
  kill();
  start_on_sick_host({{"EARSHOT_TEST_THREADS", "0"}});
  expect_comes_up();
  kill();
  start();
  expect_comes_up();
}

class RestartWithFewThreads : public RestartAtSea, public testing::WithParamInterface<int> {};

TEST_P(RestartWithFewThreads, GoesOnOrComesUpHoweverFewTheyAre) {
  search();
  kill();
  start_on_sick_host({{"EARSHOT_TEST_THREADS", std::to_string(GetParam())}});
  EXPECT_TRUE(vehicle_->sails_until([&] { return vehicle_->state() != MissionState::kStandby; })) << earshotd_->output();
  const int turns = vehicle_->turns;
  EXPECT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > turns + 5; })) << earshotd_->output();
}
/// All that it makes: for each copy of the record, for reading the journal, for writing it, and for the event log.
INSTANTIATE_TEST_SUITE_P(Threads, RestartWithFewThreads, testing::Range(1, 6));

TEST_F(RestartAtSea, GivenTooFewDescriptorsItsStatusIsOneThatAServiceStartsAgain) {
  search();
  kill();
  for (int files = 3; files < 12; ++files) {
    start_on_sick_host({{"EARSHOT_TEST_FILES", std::to_string(files)}});
    const int status = earshotd_->wait(std::chrono::seconds(3));
    EXPECT_TRUE(status == program::kLost || status == -1) << files << " files: status " << status << earshotd_->output();
    if (status == -1) kill();
  }
}

/// Standard streams, a copy of the record, and LCM's three.
constexpr int kFewestFiles = 7;

TEST_F(RestartAtSea, GivenDescriptorsForOnePortItComesUpHoweverFewTheyAre) {
  search();
  kill();
  for (const int files : {kFewestFiles, kFewestFiles + 1, kFewestFiles + 2, 20}) {
    vehicle_->health = {};
    start_on_sick_host({{"EARSHOT_TEST_FILES", std::to_string(files)}});
    EXPECT_TRUE(vehicle_->sails_until([&] { return vehicle_->state() == MissionState::kAbort && vehicle_->depth() == Meters{0.0}; }))
        << files << " files: " << earshotd_->output();
    kill();
  }
  start_on_sick_host({{"EARSHOT_TEST_FILES", std::to_string(kFewestFiles - 1)}});
  EXPECT_EQ(earshotd_->wait(std::chrono::seconds(10)), program::kLost);
  EXPECT_TRUE(is_printed("nobody commands the vehicle")) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenDescriptorsForOneOfTwoPortsItComesUpByThatAndNamesTheOther) {
  std::ofstream(folder_ / "mission.toml", std::ios::app) << "\n[[port]]\nname = \"ashore\"\nkind = \"lcm\"\n"
                                                            "url = \"udpm://239.255.76.67:7700?ttl=0\"\nroles = [\"status\"]\n";
  search();
  kill();
  start_on_sick_host({{"EARSHOT_TEST_FILES", std::to_string(kFewestFiles)}});
  expect_comes_up();
  EXPECT_TRUE(is_printed("port ashore does not open")) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenSensorsThatAreSilentItComesUpMeanwhileAndObeysAnAbort) {
  search();
  kill();
  vehicle_->fall_silent();
  const int setpoints = vehicle_->setpoints;
  start();
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->setpoints > setpoints + 2; })) << earshotd_->output();
  EXPECT_EQ(vehicle_->state(), MissionState::kSearch) << "it has not been ended for their silence" << earshotd_->output();
  EXPECT_EQ(vehicle_->depth(), Meters{0.0});
  vehicle_->order(Order::kAbort);
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->outcome.has_value(); })) << earshotd_->output();
  EXPECT_EQ(vehicle_->outcome, messages::CommandOutcome::kObeyed);
  EXPECT_EQ(vehicle_->health.end_reason, static_cast<std::int8_t>(messages::EndReason::kOperatorAbort)) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenAJournalThatTakesLongToReadItComesUpMeanwhileAndThenGoesOn) {
  search();
  kill();
  start_with_slow_reading();
  ASSERT_TRUE(vehicle_->sails_until([&] { return is_printed("goes on from"); })) << earshotd_->output();
  EXPECT_TRUE(is_printed(": SEARCH, after ")) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenAnAbortWhileTheJournalIsReadItIsAcknowledgedAtOnceAndHolds) {
  search();
  kill();
  start_with_slow_reading();
  vehicle_->order(Order::kAbort);
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->outcome == messages::CommandOutcome::kObeyed; })) << earshotd_->output();
  EXPECT_FALSE(is_printed("goes on from"));
  ASSERT_TRUE(vehicle_->sails_until([&] { return is_printed("goes on from"); })) << earshotd_->output();
  const int turns = vehicle_->turns;
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > turns + 5; })) << earshotd_->output();
  EXPECT_EQ(vehicle_->state(), MissionState::kAbort);
  EXPECT_EQ(vehicle_->health.end_reason, static_cast<std::int8_t>(messages::EndReason::kOperatorAbort)) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenAStopWhileTheJournalIsReadItEndsAndTheNextStartBringsTheVehicleUp) {
  search();
  kill();
  start_with_slow_reading();
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(std::chrono::seconds(10)), program::kInterrupted) << earshotd_->output();
  vehicle_->health = {};
  start();
  expect_comes_up();
}

TEST_F(RestartAtSea, GivenAPipeInPlaceOfTheJournalItComesUp) {
  search();
  kill();
  fs::remove(journal());
  ASSERT_EQ(::mkfifo(journal().c_str(), 0600), 0);
  start();
  expect_comes_up();
}

TEST_F(RestartAtSea, GivenAJournalThatWasFlownElsewhereItBeginsInStandbyAndCommandsNothing) {
  search();
  kill();
  const fs::path elsewhere = folder_ / "elsewhere";
  fs::create_directory(elsewhere);
  fs::rename(journal(), elsewhere / "journal.lcmlog");
  const int setpoints = vehicle_->setpoints;
  const int turns = vehicle_->turns;
  start_in(elsewhere);
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > turns + 10; })) << earshotd_->output();
  EXPECT_EQ(vehicle_->state(), MissionState::kStandby);
  EXPECT_EQ(vehicle_->setpoints, setpoints);
  EXPECT_TRUE(is_printed("no safety record of this vehicle names it")) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenThreeStartsThatEndedAtOnceTheFourthComesUp) {
  search();
  for (int i = 0; i < 3; ++i) {
    kill();
    start();
    const int setpoints = vehicle_->setpoints;
    ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->setpoints > setpoints; })) << i << earshotd_->output();
    EXPECT_TRUE(is_printed("goes on from")) << earshotd_->output();
  }
  kill();
  start();
  expect_comes_up();
  EXPECT_TRUE(is_printed("ended 3 times within a minute of its start")) << earshotd_->output();
}

}  // namespace
}  // namespace earshot
