// Needs root and a kernel with vcan and slcan: hil/bus/with-can runs it.

#include "hil/bus/serial/serial_adapter.hpp"

#include <gtest/gtest.h>
#include <net/if.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "firmware/host/transport/can_socket.hpp"

namespace earshot::hil {
namespace {

using State = n2k::ControllerState;

n2k::Frame heading(std::uint8_t number) {
  return {.identifier = 0x09F11223, .size = 8, .data = {number, 0x70, 0x5A, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD}};
}

bool comes_true(const std::function<bool()>& is_true) {
  for (int i = 0; i < 500; ++i) {
    if (is_true()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

class SerialAdapterTest : public testing::Test {
 protected:
  void SetUp() override {
    if (::if_nametoindex("vcan0") == 0) GTEST_SKIP() << "no vcan0: run me with hil/bus/with-can";
  }

  /// The next frame that comes.
  static std::optional<n2k::Frame> heard(host::CanSocket& socket) {
    n2k::Frame frame;
    if (!comes_true([&] { return socket.receive(frame) == Status::kOk; })) return std::nullopt;
    return frame;
  }
  static bool is_in(host::CanSocket& socket, State state) {
    n2k::Frame unused;
    return comes_true([&] { return socket.receive(unused) != Status::kOk && socket.controller_state() == state; });
  }
  /// What earshotd does all the time.
  static bool is_back(host::CanSocket& socket) {
    n2k::Frame unused;
    (void)socket.receive(unused);
    socket.flush(Time{} + Duration{std::chrono::steady_clock::now().time_since_epoch() / std::chrono::microseconds(1)});
    return socket.reopen();
  }
};

TEST_F(SerialAdapterTest, PassesFramesBothWays) {
  SerialAdapter adapter("vcan0");
  host::CanSocket near_end(adapter.interface());
  host::CanSocket bus("vcan0");
  ASSERT_EQ(near_end.send(heading(1)), Status::kOk);
  EXPECT_EQ(heard(bus), heading(1));
  ASSERT_EQ(bus.send(heading(2)), Status::kOk);
  EXPECT_EQ(heard(near_end), heading(2));
  EXPECT_EQ(adapter.passed(), 2U);
}

TEST_F(SerialAdapterTest, PassesFramesAndSaysSoWhileErrorPassive) {
  SerialAdapter adapter("vcan0");
  host::CanSocket near_end(adapter.interface());
  host::CanSocket bus("vcan0");
  adapter.become(State::kErrorPassive);
  EXPECT_TRUE(is_in(near_end, State::kErrorPassive));
  ASSERT_EQ(bus.send(heading(1)), Status::kOk);
  EXPECT_EQ(heard(near_end), heading(1));
  adapter.become(State::kErrorActive);
  EXPECT_TRUE(is_in(near_end, State::kErrorActive));
  EXPECT_EQ(near_end.counters().controller.passive, 1U);
}

TEST_F(SerialAdapterTest, PassesNothingWhileBusOffAndIsThereAgainAfterwards) {
  SerialAdapter adapter("vcan0");
  host::CanSocket near_end(adapter.interface());
  host::CanSocket bus("vcan0");
  adapter.become(State::kBusOff);
  EXPECT_TRUE(is_in(near_end, State::kBusOff));
  EXPECT_FALSE(near_end.is_up());
  ASSERT_EQ(bus.send(heading(1)), Status::kOk);
  EXPECT_TRUE(comes_true([&] { return adapter.refused() == 1; }));
  adapter.become(State::kErrorActive);
  EXPECT_TRUE(comes_true([&near_end] { return is_back(near_end); }));
  ASSERT_EQ(bus.send(heading(2)), Status::kOk);
  EXPECT_EQ(heard(near_end), heading(2)) << "and not what came meanwhile";
}

TEST_F(SerialAdapterTest, IsKnownToBeBusOffByOneWhoCameLaterAndThoughFramesAreSaidToBeSent) {
  SerialAdapter adapter("vcan0");
  host::CanSocket near_end(adapter.interface());
  adapter.become(State::kBusOff);
  ASSERT_TRUE(is_in(near_end, State::kBusOff));
  host::CanSocket late(adapter.interface());
  EXPECT_TRUE(comes_true([&] { return !is_back(late) && late.controller_state() == State::kBusOff; }));
  adapter.become(State::kErrorActive);
  EXPECT_TRUE(comes_true([&] { return is_back(late); }));
}

TEST_F(SerialAdapterTest, LeavesNoInterfaceBehind) {
  std::string name;
  {
    const SerialAdapter adapter("vcan0");
    name = adapter.interface();
    EXPECT_NE(::if_nametoindex(name.c_str()), 0U);
  }
  EXPECT_TRUE(comes_true([&] { return ::if_nametoindex(name.c_str()) == 0; }));
}

}  // namespace
}  // namespace earshot::hil
