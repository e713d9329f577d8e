#include "firmware/host/transport/bus_lock.hpp"

#include <gtest/gtest.h>

#include <unistd.h>
#include <string>

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

TEST(BusLock, AnInterfaceNameTooLongForAnyInterfaceIsRefusedAndNotCutToAnotherName) {
  EXPECT_THROW((void)lock_can(std::string(200, 'x')), std::system_error);
}

}  // namespace
}  // namespace earshot::host
