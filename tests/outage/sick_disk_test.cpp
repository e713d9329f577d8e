// Missions at sea on a vehicle whose disk falls ill: each is flown to its last step, and who looks at what is left is told.

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "tests/scenario/vehicle_over_lcm.hpp"
#include "tests/scenario/walk_at_sea.hpp"
#include "tests/support/private_network.hpp"

namespace earshot {
namespace {

using messages::MissionState;
using messages::Order;

constexpr int kSteps = 10;
constexpr std::string_view kReported = ": journal: the disk does not take it in time";
constexpr std::string_view kNotWhole = "earshotd: the journal is not whole: ";

class SickDisk : public WalkAtSea {
 protected:
  void SetUp() override {
    ENTER_PRIVATE_NETWORK_OR_SKIP();
    std::string mission = patient(mission_of_short_steps("search.toml"));
    replace(mission, "max_steps = 100", "max_steps = " + std::to_string(kSteps));
    write_mission(mission);
  }

  void fall_ill() const { std::ofstream(folder_ / "sick") << ""; }

  enum class From { kBeginning, kMiddle, kEnd };

  /// A search under way, on a disk that falls ill when fall_ill() says so.
  void search(VehicleOverLcm& vehicle, const std::string& sickness) {
    ::setenv("LD_PRELOAD", EARSHOT_SICK_DISK, 1);
    ::setenv("EARSHOT_TEST_DISK", sickness.c_str(), 1);
    ::setenv("EARSHOT_TEST_DISK_IS_SICK", (folder_ / "sick").c_str(), 1);
    start_earshotd({"--speed", "10"});
    for (const char* name : {"LD_PRELOAD", "EARSHOT_TEST_DISK", "EARSHOT_TEST_DISK_IS_SICK"}) ::unsetenv(name);
    EXPECT_TRUE(vehicle.sails_until([&] { return vehicle.turns > 5; })) << earshotd_->output();
    vehicle.order(Order::kStart);
    EXPECT_TRUE(vehicle.sails_until([&] { return vehicle.state() == MissionState::kSearch; })) << earshotd_->output();
  }

  /// GIVEN a mission whose disk falls ill. @return exit status
  int sail(const std::string& sickness, From from) {
    VehicleOverLcm vehicle{std::string(host::kDefaultLcmUrl)};
    if (from == From::kBeginning) fall_ill();
    search(vehicle, sickness);
    EXPECT_TRUE(vehicle.sails_until([&] { return vehicle.health.steps_taken >= kSteps / 2; })) << earshotd_->output();
    if (from == From::kMiddle) fall_ill();
    EXPECT_TRUE(vehicle.sails_until([&] { return vehicle.state() == MissionState::kDone; })) << earshotd_->output();
    EXPECT_EQ(vehicle.health.steps_taken, kSteps);
    // The journal of all but the last turns is on the disk; what comes after the others has fallen ill is more than its reserve holds.
    if (from == From::kEnd) fall_ill();
    if (from != From::kEnd) {
      EXPECT_TRUE(vehicle.sails_until([&] { return is_printed(kReported); })) << earshotd_->output();
    }
    const int more = from == From::kEnd ? 20 : 400;
    const int turns = vehicle.turns;
    EXPECT_TRUE(vehicle.sails_until([&] { return vehicle.turns > turns + more; })) << earshotd_->output();
    earshotd_->signal(SIGTERM);
    return earshotd_->wait(std::chrono::seconds(60));
  }

  [[nodiscard]] bool is_printed(std::string_view words) const { return earshotd_->output().find(words) != std::string::npos; }

  /// Orders that stand in the journal; every record of it must read back.
  [[nodiscard]] int orders_in_journal() const {
    host::JournalReader reader(folder_ / "journal.lcmlog");
    int orders = 0;
    for (host::JournalRecord record; reader.next(record);) orders += record.channel.starts_with(wire::kOperatorCommandChannel) ? 1 : 0;
    EXPECT_TRUE(reader.damages().empty());
    return orders;
  }
};

TEST_F(SickDisk, GivenADiskThatTakesASecondForEveryCallTheMissionIsFlownNothingIsLostAndTheLagIsTold) {
  EXPECT_EQ(sail("slow", From::kBeginning), 0) << earshotd_->output();
  EXPECT_TRUE(is_printed(kReported)) << earshotd_->output();
  EXPECT_FALSE(is_printed(kNotWhole)) << earshotd_->output();
  EXPECT_EQ(orders_in_journal(), 1);
  EXPECT_TRUE(board::replay(folder_ / "journal.lcmlog").is_same());
}

TEST_F(SickDisk, GivenAFullDiskFromTheFirstByteTheMissionIsFlownAndStatusThreeSaysThatNothingIsKept) {
  EXPECT_EQ(sail("full", From::kBeginning), 3);
  EXPECT_TRUE(is_printed(kReported)) << earshotd_->output();
  EXPECT_TRUE(is_printed(kNotWhole)) << earshotd_->output();
}

TEST_F(SickDisk, GivenADiskThatIsFullFromTheMiddleOnTheMissionIsFlownAndTheRestIsCounted) {
  EXPECT_EQ(sail("full", From::kMiddle), 3);
  EXPECT_TRUE(is_printed(kReported)) << earshotd_->output();
  EXPECT_TRUE(is_printed(kNotWhole)) << earshotd_->output();
  EXPECT_EQ(orders_in_journal(), 1);
}

TEST_F(SickDisk, GivenADiskThatIsFullAtTheLastTheReserveTakesTheEnd) {
  (void)sail("full", From::kEnd);
  EXPECT_EQ(orders_in_journal(), 1);
  EXPECT_TRUE(board::replay(folder_ / "journal.lcmlog").closing) << earshotd_->output();
}

TEST_F(SickDisk, GivenADiskThatBecomesReadOnlyTheMissionIsFlownAndWhatWasWrittenBeforeReadsBack) {
  EXPECT_EQ(sail("read-only", From::kMiddle), 3);
  EXPECT_TRUE(is_printed(kReported)) << earshotd_->output();
  EXPECT_TRUE(is_printed(kNotWhole)) << earshotd_->output();
  EXPECT_EQ(orders_in_journal(), 1);
}

TEST_F(SickDisk, GivenAFullDiskASearchThatASignalStopsEndsWithTheStatusOfTheLossAndNotOfTheSignal) {
  VehicleOverLcm vehicle{std::string(host::kDefaultLcmUrl)};
  fall_ill();
  search(vehicle, "full");
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(std::chrono::seconds(60)), 3) << earshotd_->output();
  EXPECT_TRUE(is_printed("ABORT, its program was stopped")) << earshotd_->output();
  EXPECT_TRUE(is_printed(kNotWhole)) << earshotd_->output();
}

}  // namespace
}  // namespace earshot
