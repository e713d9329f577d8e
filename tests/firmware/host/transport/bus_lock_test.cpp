#include "firmware/host/transport/bus_lock.hpp"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

/// Buses of this process only: tests run side by side.
std::string own_url(const std::string& options = "") {
  return "udpm://239.255.1.1:" + std::to_string(20'000 + getpid() % 10'000) + options;
}
std::string own_interface() {
  return "vcan" + std::to_string(getpid());
}

std::string complaint(const std::string& url) {
  try {
    (void)lock_lcm(url);
  } catch (const BusInUse& e) {
    return e.what();
  }
  return "";
}

TEST(BusLock, OneLcmBusIsHeldByOneAtATime) {
  const BusLock held = lock_lcm(own_url());
  EXPECT_EQ(complaint(own_url()), own_url() + ": bus_lock_test (process " + std::to_string(getpid()) + ") is using it");
}

TEST(BusLock, TheHalvesOfASimulatedFlightShareABusThatOneMissionAtSeaHasAlone) {
  const BusLock vehicle = lock_lcm(own_url(), BusPlace::kVehicle);
  const BusLock simulator = lock_lcm(own_url(), BusPlace::kSimulator);
  EXPECT_THROW((void)lock_lcm(own_url(), BusPlace::kVehicle), BusInUse) << "a second vehicle";
  EXPECT_THROW((void)lock_lcm(own_url(), BusPlace::kSimulator), BusInUse) << "a second simulator";
  EXPECT_NE(complaint(own_url()), "") << "a mission at sea";
}

TEST(BusLock, WhoStartsBothHalvesHoldsTheBusAndLeavesThemTheirPlaces) {
  BusLock flight = lock_lcm(own_url());
  EXPECT_THROW((void)lock_lcm(own_url(), BusPlace::kVehicle), BusInUse);
  flight.leave_to_children();
  const BusLock vehicle = lock_lcm(own_url(), BusPlace::kVehicle);
  EXPECT_NE(complaint(own_url()), "") << "a second flight";
}

TEST(BusLock, OptionsOfAUrlMakeNoOtherBus) {
  const BusLock held = lock_lcm(own_url("?ttl=0"));
  EXPECT_NE(complaint(own_url("?ttl=1&recv_buf_size=65536")), "");
}

TEST(BusLock, AnotherPortOrGroupIsAnotherBus) {
  const BusLock held = lock_lcm("udpm://239.255.1.1:" + std::to_string(30'000 + getpid() % 10'000));
  EXPECT_EQ(complaint(own_url()), "");
  const BusLock other = lock_lcm(own_url());
  EXPECT_EQ(complaint("udpm://239.255.1.2:" + std::to_string(20'000 + getpid() % 10'000)), "");
}

TEST(BusLock, OneCanInterfaceIsHeldByOneAtATime) {
  const BusLock held = lock_can(own_interface());
  EXPECT_THROW((void)lock_can(own_interface()), BusInUse);
}

TEST(BusLock, ABusThatWasLetGoIsFree) {
  { const BusLock held = lock_lcm(own_url()); }
  EXPECT_EQ(complaint(own_url()), "");
}

/// Another process, of the user nobody, that has the name of the bus. @return its number; -1: it could not
pid_t hold_as_nobody(const std::string& url) {
  int ready[2];
  if (::pipe(ready) != 0) return -1;
  const pid_t child = ::fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    if (::setuid(kNobody) != 0) ::_exit(1);
    const BusLock held = lock_lcm(url);
    (void)!::write(ready[1], "x", 1);
    for (;;) ::pause();
  }
  ::close(ready[1]);
  char said = 0;
  const bool is_held = ::read(ready[0], &said, 1) == 1;
  ::close(ready[0]);
  return is_held ? child : -1;
}

TEST(BusLock, AtSeaANameThatAnUnprivilegedUserTookRefusesNobody) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can be another user";
  const pid_t child = hold_as_nobody(own_url());
  ASSERT_GT(child, 0);
  EXPECT_NE(complaint(own_url()), "") << "a simulated flight leaves the bus to who has it";
  {
    const BusLock lock = lock_lcm_at_sea(own_url(), {});
    EXPECT_NE(lock.stranger().find("bus_lock_test"), std::string::npos) << lock.stranger();
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(lock_lcm_at_sea(own_url(), {}).stranger(), "");
}

TEST(BusLock, AtSeaOneOfThisUsersOwnRefusesByItsNameAndByTheServicesFile) {
  const BusLock held = lock_lcm_at_sea(own_url(), {});
  EXPECT_THROW((void)lock_lcm_at_sea(own_url(), {}), BusInUse);
  EXPECT_NE(complaint(own_url()), "");
  const support::TemporaryFolder folder;
  const BusLock in_service = lock_can_at_sea(own_interface(), folder);
  EXPECT_THROW((void)lock_can_at_sea(own_interface(), folder), BusInUse);
  EXPECT_THROW((void)lock_can_at_sea(own_interface(), {}), BusInUse) << "one that is started by hand";
  EXPECT_NO_THROW((void)lock_can_at_sea(own_interface() + "x", folder));
}

TEST(BusLock, AnInterfaceNameTooLongForAnyInterfaceIsRefusedAndNotCutToAnotherName) {
  EXPECT_THROW((void)lock_can(std::string(200, 'x')), std::system_error);
}

}  // namespace
}  // namespace earshot::host
