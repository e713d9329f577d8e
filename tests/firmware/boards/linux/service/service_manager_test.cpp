#include "firmware/boards/linux/service/service_manager.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "firmware/messages/dictionary/mission_words.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Words = std::vector<std::string>;

/// A service manager's end of the protocol.
class Manager {
 public:
  /// @param name  a path, or @NAME
  explicit Manager(const std::string& name) : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path, sizeof address.sun_path - 1);
    if (name[0] == '@') address.sun_path[0] = '\0';
    const std::size_t size = offsetof(sockaddr_un, sun_path) + name.size() + (name[0] == '@' ? 0 : 1);
    EXPECT_EQ(::bind(socket_.number(), reinterpret_cast<const sockaddr*>(&address), static_cast<socklen_t>(size)), 0);
  }
  /// Since the last call.
  Words heard() {
    Words words;
    std::string datagram(1000, '\0');
    for (ssize_t size = 0; (size = ::recv(socket_.number(), datagram.data(), datagram.size(), 0)) >= 0;)
      words.push_back(datagram.substr(0, static_cast<std::size_t>(size)));
    return words;
  }

 private:
  host::FileDescriptor socket_;
};

messages::Health health(std::uint64_t turn, messages::MissionState state = messages::MissionState::kStandby) {
  messages::Health health;
  health.turn = turn;
  health.state = state;
  return health;
}

class ServiceManagerTest : public testing::Test {
 protected:
  static ServiceManager::SteadyClock::time_point at(milliseconds time) { return ServiceManager::SteadyClock::time_point{time}; }

  const support::TemporaryFolder folder_;
  const std::string path_ = (folder_ / "notify").string();
  Manager manager_{path_};
};

TEST_F(ServiceManagerTest, HearsThatItIsReadyAfterTheFirstTurnAndEveryNewStateAndStepInWords) {
  ServiceManager told({.socket = path_});
  EXPECT_EQ(told.complaint(), "");
  EXPECT_EQ(manager_.heard(), Words{});
  told.note_turn(health(1));
  told.note_turn(health(2));
  EXPECT_EQ(manager_.heard(), Words{"READY=1\nSTATUS=STANDBY, after 0 steps"});
  messages::Health later = health(3, messages::MissionState::kSearch);
  told.note_turn(later);
  later.steps_taken = 1;
  told.note_turn(later);
  told.note_turn(later);
  later.steps_taken = 2;
  told.note_turn(later);
  EXPECT_EQ(manager_.heard(), (Words{"STATUS=SEARCH, after 0 steps", "STATUS=SEARCH, after 1 step", "STATUS=SEARCH, after 2 steps"}));
  messages::Health over = health(3, messages::MissionState::kAbort);
  over.end_reason = messages::EndReason::kNavigationStale;
  over.steps_taken = 12;
  told.note_turn(over);
  EXPECT_TRUE(support::lines_tell(manager_.heard(),
                                  {{"STATUS=ABORT", messages::to_string(messages::EndReason::kNavigationStale), "after 12 steps"}}));
  told.note_stop();
  told.note_stop();
  EXPECT_EQ(manager_.heard(), Words{"STOPPING=1"});
}

// A watchdog of 2 s is fed every half a second.
TEST_F(ServiceManagerTest, FeedsTheWatchdogFourTimesInItsTimeAndNoMoreOften) {
  ServiceManager told({.socket = path_, .watchdog = seconds(2)});
  told.note_turn(health(1), at(milliseconds(10'000)));
  EXPECT_EQ(manager_.heard(), (Words{"READY=1\nSTATUS=STANDBY, after 0 steps", "WATCHDOG=1"}));
  int meals = 0;
  for (int ms = 10'100; ms <= 20'000; ms += 100) {
    told.note_turn(health(static_cast<std::uint64_t>(ms)), at(milliseconds(ms)));
    meals += static_cast<int>(manager_.heard().size());
  }
  EXPECT_EQ(meals, 20);
}

TEST_F(ServiceManagerTest, IsNotFedByAThreadThatLivesWhileItsHeartbeatStandsStill) {
  ServiceManager told({.socket = path_, .watchdog = seconds(2)});
  told.note_turn(health(7), at(seconds(10)));
  EXPECT_EQ(manager_.heard().size(), 2U);
  for (int s = 11; s < 20; ++s) told.note_turn(health(7), at(seconds(s)));
  EXPECT_EQ(manager_.heard(), Words{});
  told.note_turn(health(8), at(seconds(20)));
  EXPECT_EQ(manager_.heard(), Words{"WATCHDOG=1"});
}

TEST_F(ServiceManagerTest, IsFedByARuntimeThatBringsTheVehicleUpBecauseItsMemoryIsDamaged) {
  ServiceManager told({.socket = path_, .watchdog = seconds(2)});
  messages::Health damaged = health(7, messages::MissionState::kAbort);
  damaged.end_reason = messages::EndReason::kMemoryFault;
  for (int s = 10; s < 13; ++s) told.note_turn(damaged, at(seconds(s)));
  EXPECT_EQ(manager_.heard().size(), 4U) << "that it is ready, and three meals";
}

TEST_F(ServiceManagerTest, IsAskedForTimeUntilTheFirstTurnAndNotAfterIt) {
  ServiceManager told({.socket = path_});
  told.ask_for(seconds(90));
  EXPECT_EQ(manager_.heard(), Words{"EXTEND_TIMEOUT_USEC=90000000"});
  told.note_turn(health(1));
  (void)manager_.heard();
  told.ask_for(seconds(90));
  EXPECT_EQ(manager_.heard(), Words{});
}

TEST_F(ServiceManagerTest, MayHaveAnAbstractName) {
  const std::string name = "@earshot-test-" + std::to_string(::getpid());
  Manager abstract(name);
  ServiceManager told({.socket = name});
  told.note_turn(health(1));
  EXPECT_EQ(abstract.heard().size(), 1U);
}

TEST_F(ServiceManagerTest, IsToldNothingWhereItsSocketIsNoneAndTheComplaintNamesIt) {
  for (const std::string& name :
       {std::string("relative"), std::string("/"), std::string("@"), std::string(108, '/'), (folder_ / "none").string()}) {
    ServiceManager told({.socket = name, .watchdog = seconds(2)});
    EXPECT_EQ(told.complaint().find("NOTIFY_SOCKET=" + name + ": "), 0U) << told.complaint();
    told.note_turn(health(1));  // and nothing happens
  }
  EXPECT_EQ(ServiceManager({}).complaint(), "") << "nobody wants to know";
}

TEST_F(ServiceManagerTest, WhoDoesNotReadDelaysNothing) {
  ServiceManager told({.socket = path_, .watchdog = milliseconds(4)});
  for (int i = 1; i < 100'000; ++i) told.note_turn(health(static_cast<std::uint64_t>(i)), at(milliseconds(i)));
  EXPECT_LT(manager_.heard().size(), 100'000U) << "what its queue held";
}

TEST(ServiceEnvironmentTest, ReadsWhatSystemdSaysAndHeedsNoWatchdogOfAnotherProcess) {
  const auto read = [](const char* usec, const std::string& pid) {
    ::setenv("NOTIFY_SOCKET", "/run/x", 1);
    ::setenv("WATCHDOG_USEC", usec, 1);
    ::setenv("WATCHDOG_PID", pid.c_str(), 1);
    const ServiceEnvironment environment = ServiceEnvironment::of_this_process();
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
    return environment;
  };
  const std::string own = std::to_string(::getpid());
  EXPECT_EQ(read("30000000", own).socket, "/run/x");
  EXPECT_EQ(read("30000000", own).watchdog, seconds(30));
  EXPECT_EQ(read("30000000", "").watchdog, seconds(30));
  EXPECT_EQ(read("30000000", "1").watchdog, std::nullopt);
  EXPECT_EQ(read("0", own).watchdog, std::nullopt);
  EXPECT_EQ(read("30s", own).watchdog, std::nullopt);
  EXPECT_EQ(ServiceEnvironment::of_this_process().socket, "");
}

}  // namespace
}  // namespace earshot::board
