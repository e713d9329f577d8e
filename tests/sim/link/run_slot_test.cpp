#include "sim/link/run_slot.hpp"

#include <gtest/gtest.h>

#include <string>

#include "firmware/host/transport/bus_lock.hpp"

namespace earshot::link {
namespace {

TEST(RunSlot, LeavesThePortOfMissionsAtSeaAlone) {
  const RunSlot slot;
  EXPECT_EQ(slot.lcm_url().find(":7667"), std::string::npos) << slot.lcm_url();
}

TEST(RunSlot, TwoRunsShareNeitherBusNorDomain) {
  const RunSlot one;
  const RunSlot other;
  EXPECT_NE(one.lcm_url(), other.lcm_url());
  EXPECT_NE(one.hydrophone_url(), other.hydrophone_url());
  EXPECT_NE(one.hydrophone_url(), one.lcm_url());
  EXPECT_NE(one.domain(), other.domain());
}

TEST(RunSlot, HoldsItsBusAgainstAnybodyWhoNamesIt) {
  const RunSlot slot;
  EXPECT_THROW((void)host::lock_lcm(slot.lcm_url()), host::BusInUse);
}

}  // namespace
}  // namespace earshot::link
