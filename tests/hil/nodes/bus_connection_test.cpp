#include "hil/nodes/bus_connection.hpp"

#include <gtest/gtest.h>
#include <net/if.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>

#include "firmware/host/transport/can_socket.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/hil/nodes/listening.hpp"

namespace earshot::hil {
namespace {

using namespace std::chrono_literals;

/// Each has a bus of its own beside vcan0. Run by hil/bus/with-can, which sets CAN_REQUIRED=1.
class BusConnectionTest : public testing::Test {
 protected:
  void SetUp() override {
    if (::if_nametoindex("vcan0") == 0) {
      const char* const required = std::getenv("CAN_REQUIRED");
      ASSERT_FALSE(required != nullptr && std::string(required) == "1") << "CAN_REQUIRED=1, but there is no vcan0";
      GTEST_SKIP() << "no interface vcan0: run me with hil/bus/with-can";
    }
  }
  void TearDown() override { EXPECT_TRUE(::if_nametoindex("vcan77") == 0 || ip("del vcan77") == 0); }

  static int ip(const std::string& what) { return std::system(("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link " + what).c_str()); }
  static void make_bus() {
    ASSERT_EQ(ip("add vcan77 type vcan"), 0);
    ASSERT_EQ(ip("set vcan77 up"), 0);
  }

  /// Turns until `is_true`. @return false when it has not come true in 20 s
  [[nodiscard]] bool turns_until(BusConnection& bus, const std::function<bool()>& is_true) {
    for (const auto deadline = std::chrono::steady_clock::now() + 20s; std::chrono::steady_clock::now() < deadline;) {
      bus.turn();
      if (is_true()) return true;
    }
    return false;
  }

  /// What others have heard by now.
  static Frames heard(host::CanSocket& other) {
    Frames frames;
    for (n2k::Frame frame; other.receive(frame) == Status::kOk;) frames.push_back(frame);
    return frames;
  }

  static VehicleSetup setup() {
    VehicleSetup setup;
    setup.source.snr = [](Meters) { return Decibels{3.0}; };
    setup.utc = ScaledClock::utc;
    return setup;
  }

  const ScaledClock clock_{20.0};
  EmulatedVehicle vehicle_{setup()};
};

TEST_F(BusConnectionTest, SaysWhatTheVehicleSaysAndGivesItWhatOthersSay) {
  make_bus();
  host::CanSocket other("vcan77");
  BusConnection bus("vcan77", vehicle_, clock_);
  Frames frames;
  ASSERT_TRUE(turns_until(bus, [&] {
    const Frames more = heard(other);
    frames.insert(frames.end(), more.begin(), more.end());
    return !of_group(n2k::kPositionPgn, frames).empty() && !of_group(n2k::kSnrPgn, frames).empty();
  }));
  for (const auto deadline = std::chrono::steady_clock::now() + 5s;
       frames.size() < bus.sent() && std::chrono::steady_clock::now() < deadline;) {
    const Frames more = heard(other);
    frames.insert(frames.end(), more.begin(), more.end());
  }
  EXPECT_EQ(frames.size(), bus.sent());
  n2k::SetpointFrames setpoint;
  ASSERT_EQ(n2k::compose_setpoint({.heading = Radians{1.0}, .speed = MetersPerSecond{2.0}, .depth = Meters{30.0}, .waypoint = {}}, 0x40, 0,
                                  setpoint),
            Status::kOk);
  for (const n2k::Frame& frame : setpoint) ASSERT_EQ(other.send(frame), Status::kOk);
  EXPECT_TRUE(turns_until(bus, [&] { return vehicle_.autopilot()->taken() == 1; }));
  EXPECT_EQ(bus.received(), setpoint.size());
  EXPECT_EQ(bus.lost(), 0U);
}

TEST_F(BusConnectionTest, WaitsForAnInterfaceThatIsMissing) {
  BusConnection bus("vcan77", vehicle_, clock_);
  EXPECT_FALSE(bus.is_up());
  bus.turn();
  EXPECT_FALSE(bus.is_up());
  make_bus();
  ASSERT_TRUE(turns_until(bus, [&] { return bus.is_up(); }));
  const std::uint64_t before = bus.sent();
  EXPECT_TRUE(turns_until(bus, [&] { return bus.sent() > before + 50; }));
}

TEST_F(BusConnectionTest, KeepsNothingForWhenAnInterfaceThatWentDownComesBack) {
  make_bus();
  BusConnection bus("vcan77", vehicle_, clock_);
  ASSERT_TRUE(turns_until(bus, [&] { return bus.sent() > 50; }));
  ASSERT_EQ(ip("set vcan77 down"), 0);
  ASSERT_TRUE(turns_until(bus, [&] { return !bus.is_up(); }));
  // Three seconds of the vehicle's time, in which some 130 frames would have gone.
  const Time down = clock_.now();
  ASSERT_TRUE(turns_until(bus, [&] { return clock_.now() - down > Duration::seconds(3); }));
  EXPECT_GT(bus.lost(), 0U);
  ASSERT_EQ(ip("set vcan77 up"), 0);
  host::CanSocket other("vcan77");
  ASSERT_TRUE(turns_until(bus, [&] { return bus.is_up(); }));
  // What comes at once is what is due now: each message once. Five fast packets' worth would be more.
  EXPECT_LT(heard(other).size(), 30U);
  EXPECT_TRUE(turns_until(bus, [&] { return !of_group(n2k::kPositionPgn, heard(other)).empty(); }));
}

}  // namespace
}  // namespace earshot::hil
