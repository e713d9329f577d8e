// earshotd under a service manager, and the exit statuses by which that judges it.

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "tests/scenario/vehicle_over_lcm.hpp"
#include "tests/scenario/walk_at_sea.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

using messages::MissionState;
using messages::Order;
using std::chrono::milliseconds;
using std::chrono::seconds;

class ServiceAtSea : public WalkAtSea {
 protected:
  void SetUp() override {
    ENTER_PRIVATE_NETWORK_OR_SKIP();
    std::string mission = patient(mission_of_short_steps("search.toml"));
    replace(mission, "max_steps = 100", "max_steps = 5");
    write_mission(mission);
  }

  /// GIVEN a search under way.
  void start(VehicleOverLcm& vehicle, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"--speed", "10"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    start_earshotd(arguments);
    ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.turns > 5; })) << earshotd_->output();
  }
  void search(VehicleOverLcm& vehicle) {
    vehicle.order(Order::kStart);
    ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.state() == MissionState::kSearch; })) << earshotd_->output();
  }
  int stop() {
    earshotd_->signal(SIGTERM);
    return earshotd_->wait(seconds(30));
  }

  const std::string url_{host::kDefaultLcmUrl};
};

TEST_F(ServiceAtSea, GivenNoSearchThatWasBegunAStopIsStatusZero) {
  VehicleOverLcm vehicle(url_);
  start(vehicle);
  EXPECT_EQ(stop(), program::kDone) << earshotd_->output();
}

TEST_F(ServiceAtSea, GivenASearchThatEndedDoneAStopIsStatusZero) {
  VehicleOverLcm vehicle(url_);
  start(vehicle);
  search(vehicle);
  ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.state() == MissionState::kDone; })) << earshotd_->output();
  EXPECT_EQ(stop(), program::kDone) << earshotd_->output();
}

TEST_F(ServiceAtSea, GivenASearchThatAnOperatorAbortedAStopIsStatusFour) {
  VehicleOverLcm vehicle(url_);
  start(vehicle);
  search(vehicle);
  vehicle.order(Order::kAbort);
  ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.state() == MissionState::kAbort; })) << earshotd_->output();
  EXPECT_EQ(stop(), program::kAborted) << earshotd_->output();
}

TEST_F(ServiceAtSea, GivenASearchUnderWayAStopIsStatusFive) {
  VehicleOverLcm vehicle(url_);
  start(vehicle);
  search(vehicle);
  EXPECT_EQ(stop(), program::kInterrupted) << earshotd_->output();
}

TEST_F(ServiceAtSea, GivenAWatchdogItIsFedByTurnsAndNotByAProcessThatIsHalted) {
  const std::string path = (folder_ / "notify").string();
  const host::FileDescriptor manager(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(manager.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const auto heard = [&manager] {
    std::string all;
    std::string datagram(1000, '\0');
    for (ssize_t size = 0; (size = ::recv(manager.number(), datagram.data(), datagram.size(), 0)) >= 0;)
      all += datagram.substr(0, static_cast<std::size_t>(size)) + "\n";
    return all;
  };
  ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
  ::setenv("WATCHDOG_USEC", "400000", 1);
  VehicleOverLcm vehicle(url_);
  start(vehicle);
  for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC"}) ::unsetenv(name);
  std::string words = heard();
  EXPECT_EQ(words.find("READY=1\nSTATUS=STANDBY, after 0 steps\nWATCHDOG=1\n"), 0U) << words;
  search(vehicle);
  EXPECT_TRUE(
      vehicle.sails_until([&] { return (words += heard()).find("STATUS=SEARCH, after 0 steps\nWATCHDOG=1\n") != std::string::npos; }));

  earshotd_->signal(SIGSTOP);
  std::this_thread::sleep_for(milliseconds(100));  // what was on its way
  (void)heard();
  std::this_thread::sleep_for(milliseconds(400));
  EXPECT_EQ(heard(), "") << "a manager would end it now";
  earshotd_->signal(SIGCONT);
  words.clear();
  EXPECT_TRUE(vehicle.sails_until([&] { return (words += heard()).find("WATCHDOG=1\n") != std::string::npos; }));
  (void)stop();  // its vehicle sailed on while it was halted: a rule may have ended the search
  words = heard();
  EXPECT_NE(words.find("STOPPING=1\n"), std::string::npos) << words;
}

TEST_F(ServiceAtSea, GivenANotifySocketThatIsNoneItSaysSoAndFlies) {
  ::setenv("NOTIFY_SOCKET", "nowhere", 1);
  VehicleOverLcm vehicle(url_);
  start(vehicle, {"--log", "journal"});
  ::unsetenv("NOTIFY_SOCKET");
  EXPECT_EQ(stop(), program::kDone);
  EXPECT_TRUE(support::has_line(earshotd_->output(), {"<4>warning", "NOTIFY_SOCKET=nowhere", "nor @NAME"})) << earshotd_->output();
}

TEST_F(ServiceAtSea, GivenALogForProgramsEveryLineOfItIsOneObject) {
  VehicleOverLcm vehicle(url_);
  start(vehicle, {"--log", "json"});
  search(vehicle);
  EXPECT_EQ(stop(), program::kInterrupted);
  const std::string output = earshotd_->output();
  std::size_t lines = 0;
  for (std::size_t at = 0; at < output.size(); at = output.find('\n', at) + 1, ++lines) {
    const std::string line = output.substr(at, output.find('\n', at) - at);
    EXPECT_TRUE(line.starts_with("{\"severity\": \"") && line.ends_with("\"}")) << line;
  }
  EXPECT_GT(lines, 5U);
  EXPECT_NE(output.find("\"event\": \"state\""), std::string::npos) << output;
}

}  // namespace
}  // namespace earshot
