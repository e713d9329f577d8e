// earshotd --prove-no-alloc: whole missions at sea, and what must be caught.

#include <gtest/gtest.h>

#include <unistd.h>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/scenario/payload_over_can.hpp"
#include "tests/scenario/vehicle_over_lcm.hpp"
#include "tests/scenario/walk_at_sea.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/process.hpp"
#include "tests/support/secret_file.hpp"
#include "tests/support/signed_policy.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
using messages::MissionState;
using messages::Order;

const fs::path kBin = EARSHOT_BIN_DIR;

class NoAllocation : public WalkAtSea {
 protected:
  void write_mission(const std::string& name, const std::string& steps) const {
    std::string mission = patient(mission_of_short_steps(name));
    replace(mission, "max_steps = 100", "max_steps = " + steps);
    WalkAtSea::write_mission(mission);
  }

  void start_proof(std::vector<std::string> more) {
    more.emplace_back("--prove-no-alloc");
    start_earshotd(more);
  }

  /// SIGTERM and its end. @return exit status
  int stop() {
    earshotd_->signal(SIGTERM);
    return earshotd_->wait(30s);
  }

  void expect_output(std::string_view words) const {
    EXPECT_NE(earshotd_->output().find(words), std::string::npos) << words << "\nin:\n" << earshotd_->output();
  }
};

class NoAllocationOverLcm : public NoAllocation {
 protected:
  void SetUp() override { ENTER_PRIVATE_NETWORK_OR_SKIP(); }

  /// A flight that stays in STANDBY for some turns, with a library in it that asks for memory.
  /// @param in   the system call beside which it does
  /// @param how  what it does
  /// @return exit status
  int stand_by_asking(const std::string& in, const std::string& how) {
    write_mission("search.toml", "3");
    VehicleOverLcm vehicle{std::string(host::kDefaultLcmUrl)};
    ::setenv("LD_PRELOAD", EARSHOT_ASKS_FOR_MEMORY, 1);
    ::setenv("EARSHOT_TEST_ASKS_IN", in.c_str(), 1);
    ::setenv("EARSHOT_TEST_ASKS_BY", how.c_str(), 1);
    start_proof({});
    for (const char* name : {"LD_PRELOAD", "EARSHOT_TEST_ASKS_IN", "EARSHOT_TEST_ASKS_BY"}) ::unsetenv(name);
    EXPECT_TRUE(vehicle.sails_until([&] { return vehicle.turns >= 10; })) << earshotd_->output();
    return stop();
  }
};

TEST_F(NoAllocationOverLcm, GivenAWholeMissionWithRefusedOrdersAndNonsenseOnTheBusThereIsNoneAndMemoryStaysAsItWas) {
  const std::string url(host::kDefaultLcmUrl);
  write_mission("search.toml", "20");
  VehicleOverLcm vehicle(url);
  start_proof({"--speed", "10"});
  ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.turns > 20; })) << earshotd_->output();
  vehicle.order(Order::kComplete);  // refused in STANDBY
  vehicle.send_nonsense();
  vehicle.order(Order::kStart);
  ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.state() != MissionState::kStandby; })) << earshotd_->output();
  ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.state() != MissionState::kSearch; })) << earshotd_->output();
  EXPECT_EQ(vehicle.state(), MissionState::kDone);
  EXPECT_EQ(vehicle.health.steps_taken, 20);
  EXPECT_EQ(vehicle.health.commands_refused, 1);
  EXPECT_EQ(stop(), 0);
  expect_output("\nearshotd: 0 allocations in 5 threads over ");
  expect_output("  runtime, of 925696 allowed\n");
  expect_output("     7159244  journal ring\n");
  expect_output("      262144  stack of thread journal\n");
  expect_output("      262144  stack of thread event-log\n");
  for (const char* event_log : {" UTC: STANDBY\n", " UTC: SEARCH\n", " UTC: DONE, all steps are taken, after 20 steps\n"})
    expect_output(event_log);
  expect_output("earshotd: stopped by a signal after ");
  expect_output(" s, in DONE; it ended in DONE, all steps are taken, after 20 steps; journal ");
  expect_output(" in STANDBY, ");
  expect_output(" in SEARCH, ");
  // Of the vehicle that has no configuration; of the proof there is none.
  EXPECT_EQ(earshotd_->output().rfind("warning"), earshotd_->output().find("warning: without --vehicle")) << earshotd_->output();
  EXPECT_EQ(earshotd_->output().find("has grown"), std::string::npos);
}

TEST_F(NoAllocationOverLcm, GivenAKeyThereIsNoneAsItTellsItsChallengeAndRefusesWhatIsNotMarkedForIt) {
  write_mission("search.toml", "20");
  std::ofstream(folder_ / "mission.toml", std::ios::app) << "\n[authority]\nkey_file = \"vehicle.key\"\n";
  support::write_secret_file(folder_ / "vehicle.key", std::string(64, '1'));
  VehicleOverLcm vehicle{std::string(host::kDefaultLcmUrl)};
  start_proof({});
  ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.turns > 20; })) << earshotd_->output();
  vehicle.order(Order::kStart);
  ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.health.commands_refused > 0; })) << earshotd_->output();
  EXPECT_EQ(vehicle.state(), MissionState::kStandby);
  EXPECT_EQ(stop(), 0);
  expect_output("\nearshotd: 0 allocations in 5 threads over ");
  expect_output("an order was refused: its mark is missing or wrong");
}

TEST_F(NoAllocationOverLcm, GivenALinkThatGoesDownAndComesBackItIsOpenedAgainWithoutAny) {
  write_mission("search.toml", "20");
  VehicleOverLcm vehicle{std::string(host::kDefaultLcmUrl)};
  start_proof({});
  ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.turns > 3; })) << earshotd_->output();
  for (auto pause = 1s; vehicle.health.ports[0].unsent == 0 && pause <= 16s; pause *= 2) {
    ASSERT_EQ(std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin ip link set lo down"), 0);
    std::this_thread::sleep_for(pause);  // some turns whose messages have no way
    ASSERT_EQ(std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link set lo up && ip route add 224.0.0.0/4 dev lo"), 0);
    vehicle.take_new_routes();
    const int heard = vehicle.turns;
    ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.turns > heard + 10; })) << earshotd_->output();
  }
  EXPECT_GT(vehicle.health.ports[0].unsent, 0);
  EXPECT_EQ(stop(), 0);
  const std::string port = " UTC: port 1, vehicle, LCM " + std::string(host::kDefaultLcmUrl) + ": its link is ";
  expect_output(port + "down; tried again once a second\n");
  expect_output(port + "up again");
  expect_output("earshotd: vehicle, LCM " + std::string(host::kDefaultLcmUrl) + ": ");
  expect_output(" messages could not be sent, because their link was down or its buffer full: check ");
  expect_output("earshotd: warning: no SEARCH was flown, so that of a search nothing is proven");
  expect_output("\nearshotd: 0 allocations in 5 threads over ");
}

TEST_F(NoAllocationOverLcm, GivenAPortThatAllocatesAsItReadsTheFlightEndsWithOneAndSaysWhere) {
  EXPECT_EQ(stand_by_asking("recvfrom", "malloc"), 1);
  expect_output("memory was asked for after arming, in 5 threads over ");
  expect_output("(earshotd): ");
  expect_output("asks_for_memory");
}

TEST_F(NoAllocationOverLcm, GivenAPortThatAllocatesAsItSendsByAlignedNewTheFlightEndsWithOne) {
  EXPECT_EQ(stand_by_asking("sendmsg", "aligned new"), 1);
  expect_output("(earshotd): ");
}

TEST_F(NoAllocationOverLcm, GivenAnAllocationInTheJournalsThreadTheFlightEndsWithOneAndNamesTheThread) {
  EXPECT_EQ(stand_by_asking("fdatasync", "malloc"), 1);
  expect_output("(journal): ");
  EXPECT_EQ(earshotd_->output().find("(earshotd): "), std::string::npos) << earshotd_->output();
}

TEST_F(NoAllocationOverLcm, GivenAClockThatMapsMemoryTheFlightEndsWithOne) {
  EXPECT_EQ(stand_by_asking("ppoll", "mmap"), 1);
  expect_output(": 0 allocations, 0 releases, ");
}

TEST_F(NoAllocationOverLcm, GivenABareSystemCallThatMapsMemoryTheFlightEndsWithOneBecauseItsAddressSpaceHasGrown) {
  EXPECT_EQ(stand_by_asking("ppoll", "system call"), 1);
  expect_output("the memory of the process has grown: address space by ");
}

TEST_F(NoAllocation, GivenASimulationItIsRefused) {
  write_mission("search.toml", "3");
  start_proof({"--simulation", "7"});
  EXPECT_EQ(earshotd_->wait(30s), 2);
  expect_output("--prove-no-alloc: not with --simulation");
}

TEST_F(NoAllocation, GivenNavigationAndSetPointsOverCanThereIsNoneInAWholeMission) {
  const std::string url = "udpm://239.255.76.67:27498?ttl=0";  // beyond those of flights and other tests
  write_mission("search_over_can.toml", "3");
  VehicleOverLcm payload(url);
  start_proof({"--lcm-url", url, "--can-interface", "vcan0"});
  const support::Process vehicle(kBin / "autopilot_over_can", {"vcan0"}, folder_ / "vehicle.txt");
  ASSERT_TRUE(payload.sails_until([&] { return payload.health.port_count > 0 && payload.health.ports[0].received > 5; }))
      << vehicle.output() << earshotd_->output();
  if (std::system("ip link set vcan0 down") == 0) {  // only root may
    ASSERT_TRUE(payload.sails_until([&] { return payload.health.ports[0].link_up == 0; })) << earshotd_->output();
    ASSERT_EQ(std::system("ip link set vcan0 up"), 0);
    ASSERT_TRUE(payload.sails_until([&] { return payload.health.ports[0].link_up != 0; })) << earshotd_->output();
  }
  payload.order(Order::kStart);
  ASSERT_TRUE(payload.sails_until([&] { return payload.state() == MissionState::kDone; })) << earshotd_->output();
  EXPECT_EQ(stop(), 0);
  expect_output("\nearshotd: 0 allocations in 5 threads over ");
}

TEST_F(NoAllocation, GivenAMissionOverCanAloneThereIsNoneFromStandbyToItsEnd) {
  write_mission("search_over_can_alone.toml", "3");
  start_proof({"--can-interface", "vcan0"});
  PayloadOverCan payload("vcan0");
  const support::Process vehicle(kBin / "autopilot_over_can", {"vcan0"}, folder_ / "vehicle.txt");
  const auto has_fixes = [&] { return !payload.ports.empty() && payload.ports[0].received > 5; };
  ASSERT_TRUE(payload.listens_until(has_fixes)) << vehicle.output() << earshotd_->output();
  EXPECT_EQ(payload.earshot, 64) << "the address that it claimed";
  if (std::system("ip link set vcan0 down") == 0) {  // only root may
    std::this_thread::sleep_for(2s);
    ASSERT_EQ(std::system("ip link set vcan0 up"), 0);
    const int heard = payload.healths;
    ASSERT_TRUE(payload.listens_until([&] { return payload.healths > heard + 1; })) << earshotd_->output();
  }
  payload.order(Order::kComplete);  // refused in STANDBY
  payload.order(Order::kStart);
  ASSERT_TRUE(payload.listens_until([&] { return payload.health.state == MissionState::kDone; })) << earshotd_->output();
  EXPECT_EQ(payload.health.end_reason, messages::EndReason::kStepsUsedUp);
  EXPECT_EQ(payload.health.steps_taken, 3);
  EXPECT_EQ(payload.decisions, 3);
  ASSERT_EQ(payload.acknowledgements.size(), 2);
  EXPECT_EQ(payload.acknowledgements[0].outcome, messages::CommandOutcome::kNotInThisState);
  EXPECT_EQ(payload.acknowledgements[1].outcome, messages::CommandOutcome::kObeyed);
  EXPECT_EQ(stop(), 0);
  expect_output("\nearshotd: 0 allocations in 5 threads over ");
}

}  // namespace
}  // namespace earshot
