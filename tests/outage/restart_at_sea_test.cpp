// What becomes of a vehicle whose earshotd was killed in mid-search and is started again, as its service does, when something is wrong by
// then: it goes on, or comes up, and what was ordered holds.

#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/transport/bus_lock.hpp"
#include "tests/scenario/vehicle_over_lcm.hpp"
#include "tests/scenario/walk_at_sea.hpp"
#include "tests/support/private_network.hpp"

namespace earshot {
namespace {

namespace fs = std::filesystem;
using messages::MissionState;
using messages::Order;

class RestartAtSea : public WalkAtSea {
 protected:
  void SetUp() override {
    ENTER_PRIVATE_NETWORK_OR_SKIP();
    std::string mission = patient(mission_of_short_steps("search.toml"));
    replace(mission, "speed_mps = 20.0", "speed_mps = 2.0");  // the rule that wants progress waits for seconds
    write_mission(mission);
    vehicle_.emplace(std::string(host::kDefaultLcmUrl));
  }

  void start(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"--resume", "--speed", "10"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    start_earshotd(arguments);
  }

  /// GIVEN a search under way that a power cut, or a crash, ends.
  void search(const std::string& sickness = "") {
    if (!sickness.empty()) {
      ::setenv("LD_PRELOAD", EARSHOT_SICK_DISK, 1);
      ::setenv("EARSHOT_TEST_DISK", sickness.c_str(), 1);
      ::setenv("EARSHOT_TEST_DISK_IS_SICK", (folder_ / "sick").c_str(), 1);
    }
    start();
    for (const char* name : {"LD_PRELOAD", "EARSHOT_TEST_DISK", "EARSHOT_TEST_DISK_IS_SICK"}) ::unsetenv(name);
    ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > 5; })) << earshotd_->output();
    vehicle_->order(Order::kStart);
    ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->state() == MissionState::kSearch && vehicle_->health.steps_taken > 0; }))
        << earshotd_->output();
  }
  void kill() {
    earshotd_->signal(SIGKILL);
    (void)earshotd_->wait(std::chrono::seconds(10));
    vehicle_->health = {};
  }

  /// The vehicle is told to stop and come up. (Within ten seconds: `outages`, where it may be measured.)
  void expect_comes_up() {
    EXPECT_TRUE(vehicle_->sails_until([&] { return vehicle_->state() == MissionState::kAbort && vehicle_->depth() == Meters{0.0}; }))
        << earshotd_->output();
    EXPECT_EQ(earshotd_->wait(std::chrono::milliseconds(0)), -1) << "it goes on until it is stopped" << earshotd_->output();
  }

  /// Started again, and told to come up while its journal is read.
  void start_with_slow_reading() {
    ::setenv("LD_PRELOAD", EARSHOT_SICK_HOST, 1);
    ::setenv("EARSHOT_TEST_READING_S", "12", 1);
    start();
    for (const char* name : {"LD_PRELOAD", "EARSHOT_TEST_READING_S"}) ::unsetenv(name);
    const int setpoints = vehicle_->setpoints;
    ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->setpoints > setpoints; })) << earshotd_->output();
    EXPECT_FALSE(is_said("goes on from")) << "before it has been read";
    EXPECT_EQ(vehicle_->depth(), Meters{0.0});
    EXPECT_EQ(vehicle_->state(), MissionState::kSearch);
  }
  [[nodiscard]] bool is_said(std::string_view words) const { return earshotd_->output().find(words) != std::string::npos; }
  [[nodiscard]] fs::path journal() const { return folder_ / "journal.lcmlog"; }

  std::optional<VehicleOverLcm> vehicle_;  ///< in the test's own network
};

TEST_F(RestartAtSea, GivenNothingWrongItGoesOn) {
  search();
  kill();
  start();
  EXPECT_TRUE(vehicle_->sails_until([&] { return is_said("goes on from") && vehicle_->turns > 5; })) << earshotd_->output();
  EXPECT_TRUE(is_said(": SEARCH, after ")) << earshotd_->output();
}

/// The record has a copy in memory.
class SickDiskRestart : public RestartAtSea, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    RestartAtSea::SetUp();
    fs::create_directory(folder_ / "memory");
    ::setenv("RUNTIME_DIRECTORY", (folder_ / "memory").c_str(), 1);
  }
  void TearDown() override { ::unsetenv("RUNTIME_DIRECTORY"); }
};

TEST_P(SickDiskRestart, AnAbortThatWasAcknowledgedHoldsThoughTheDiskTookNothingOfJournalAndRecord) {
  search(GetParam());
  std::ofstream(folder_ / "sick") << "";
  vehicle_->order(Order::kAbort);
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->state() == MissionState::kAbort; })) << earshotd_->output();
  kill();
  fs::remove(folder_ / "sick");
  start();
  expect_comes_up();
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

TEST_F(RestartAtSea, GivenAJournalThatTakesLongToReadItComesUpMeanwhileAndThenGoesOn) {
  search();
  kill();
  start_with_slow_reading();
  ASSERT_TRUE(vehicle_->sails_until([&] { return is_said("goes on from"); })) << earshotd_->output();
  EXPECT_TRUE(is_said(": SEARCH, after ")) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenAnAbortWhileTheJournalIsReadItIsAcknowledgedAtOnceAndHolds) {
  search();
  kill();
  start_with_slow_reading();
  vehicle_->order(Order::kAbort);
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->outcome == messages::CommandOutcome::kObeyed; })) << earshotd_->output();
  EXPECT_FALSE(is_said("goes on from"));
  ASSERT_TRUE(vehicle_->sails_until([&] { return is_said("goes on from"); })) << earshotd_->output();
  const int turns = vehicle_->turns;
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > turns + 5; })) << earshotd_->output();
  EXPECT_EQ(vehicle_->state(), MissionState::kAbort);
  EXPECT_EQ(vehicle_->health.end_reason, static_cast<std::int8_t>(messages::EndReason::kOperatorAbort)) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenAStopWhileTheJournalIsReadItEndsInOrderAndNothingIsUnderWayAfterIt) {
  search();
  kill();
  start_with_slow_reading();
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(std::chrono::seconds(10)), program::kInterrupted) << earshotd_->output();
  vehicle_->health = {};
  const int turns = vehicle_->turns;
  start();
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > turns + 5; })) << earshotd_->output();
  EXPECT_EQ(vehicle_->state(), MissionState::kStandby) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenAJournalThatWasFlownElsewhereItBeginsInStandbyAndCommandsNothing) {
  search();
  kill();
  const fs::path elsewhere = folder_ / "elsewhere";
  fs::create_directory(elsewhere);
  fs::rename(journal(), elsewhere / "journal.lcmlog");
  const int setpoints = vehicle_->setpoints;
  const int turns = vehicle_->turns;
  earshotd_ = std::make_unique<support::Process>(
      fs::path(EARSHOT_BIN_DIR) / "earshotd",
      std::vector<std::string>{folder_ / "mission.toml", "--policy", folder_ / "walk.policy", "--public-key", folder_ / "walk.pub", "--out",
                               elsewhere, "--resume", "--speed", "10"},
      folder_ / "earshotd.txt");
  ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > turns + 10; })) << earshotd_->output();
  EXPECT_EQ(vehicle_->state(), MissionState::kStandby);
  EXPECT_EQ(vehicle_->setpoints, setpoints);
  EXPECT_TRUE(is_said("no safety record of this vehicle names it")) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenThreeStartsThatEndedAtOnceTheFourthComesUp) {
  search();
  for (int i = 0; i < 3; ++i) {
    kill();
    start();
    const int setpoints = vehicle_->setpoints;
    ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->setpoints > setpoints; })) << i << earshotd_->output();
    EXPECT_TRUE(is_said("goes on from")) << earshotd_->output();
  }
  kill();
  start();
  expect_comes_up();
  EXPECT_TRUE(is_said("ended 3 times within a minute of its start")) << earshotd_->output();
}

TEST_F(RestartAtSea, GivenAFlightUnderWayASecondProgramWithItsFolderIsRefusedAndTriedAgain) {
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
