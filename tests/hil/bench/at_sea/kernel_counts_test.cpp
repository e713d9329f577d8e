// Needs root and a kernel with vcan, slcan and netem: hil/bus/with-can runs it.

#include "hil/bench/at_sea/kernel_counts.hpp"

#include <gtest/gtest.h>
#include <net/if.h>

#include <chrono>
#include <thread>

#include "firmware/host/transport/can_socket.hpp"
#include "hil/bus/serial/serial_adapter.hpp"

namespace earshot::hil {
namespace {

class KernelCountsTest : public testing::Test {
 protected:
  void SetUp() override {
    if (::if_nametoindex("vcan0") == 0) GTEST_SKIP() << "no vcan0: run me with hil/bus/with-can";
  }
};

TEST_F(KernelCountsTest, KnowHowOftenAControllerWasInWhichTrouble) {
  using State = n2k::ControllerState;
  SerialAdapter adapter("vcan0");
  const auto come_to_be = [&](std::uint64_t error_passive, std::uint64_t bus_off) {
    for (int i = 0; i < 200; ++i) {
      const std::optional<ControllerCounts> counts = controller_counts(adapter.interface());
      if (counts && counts->error_passive == error_passive && counts->bus_off == bus_off) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  };
  EXPECT_TRUE(come_to_be(0, 0));
  adapter.become(State::kErrorPassive);
  EXPECT_TRUE(come_to_be(1, 0));
  adapter.become(State::kBusOff);
  EXPECT_TRUE(come_to_be(1, 1));
}

TEST_F(KernelCountsTest, KnowNothingOfAnInterfaceWithoutAControllerOrOfNone) {
  EXPECT_FALSE(controller_counts("vcan0").has_value());
  EXPECT_FALSE(controller_counts("nothing'; exit 0").has_value());
  EXPECT_FALSE(netem_counts("vcan0").has_value());
}

TEST_F(KernelCountsTest, KnowWhatNetemDroppedAndWhatItPassed) {
  host::CanSocket socket("vcan0");
  const auto sent = [&socket] { return socket.send({.identifier = 0x09F11223, .size = 0, .data = {}}) == Status::kOk; };
  ASSERT_TRUE(set_netem("vcan0", "loss 100%"));
  EXPECT_TRUE(sent() && sent());
  EXPECT_EQ(netem_counts("vcan0").value_or(NetemCounts{}).dropped, 2U);
  ASSERT_TRUE(set_netem("vcan0", ""));
  ASSERT_TRUE(set_netem("vcan0", "delay 1us"));
  EXPECT_TRUE(sent());
  for (int i = 0; i < 200 && netem_counts("vcan0").value_or(NetemCounts{}).passed == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(netem_counts("vcan0").value_or(NetemCounts{}).passed, 1U);
  EXPECT_TRUE(set_netem("vcan0", ""));
  EXPECT_FALSE(set_netem("vcan0", "whatever 5%"));
}

}  // namespace
}  // namespace earshot::hil
