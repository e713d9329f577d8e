#include <algorithm>
#include <array>

#include "firmware/boards/linux/can/can_port.hpp"
#include "firmware/messages/autopilot_status.hpp"
#include "firmware/messages/hydrophone_status.hpp"
#include "firmware/messages/vehicle_status.hpp"
#include "tests/firmware/boards/linux/can/bus_rig.hpp"

namespace earshot::board {
namespace {

using host::Role;

constexpr n2k::Name kNameOfB = 0xC0A0'961C'E76F'E09D;
constexpr std::uint8_t kA = 0x10;
constexpr std::uint8_t kB = 0x11;

// Frames by hand; two bits each: 0 no, 1 yes, 2 error, 3 not available.

/// 65293: leak in bits 0 and 1 of byte 3, ground fault in bits 2 and 3.
n2k::Frame hull(std::uint8_t states, std::uint8_t source = kA) {
  return {.identifier = 0x04FF'0D00U | source, .size = 8, .data = {0xFC, 0x9F, 0, states, 0xFF, 0xFF, 0xFF, 0xFF}};
}
constexpr std::uint8_t kDry = 0xFC;
constexpr std::uint8_t kWet = 0xFD;

/// 128267, 42.5 m.
n2k::Frame altitude(std::uint8_t source = kA) {
  return {.identifier = 0x0DF5'0B00U | source, .size = 8, .data = {0, 0x9A, 0x10, 0, 0, 0xFF, 0x7F, 0xFF}};
}

/// 127506, 73 %.
constexpr std::array kCharge{n2k::Frame{.identifier = 0x19F2'1210, .size = 8, .data = {0x00, 11, 0xFF, 0, 0, 73, 0xFF, 0xFF}},
                             n2k::Frame{.identifier = 0x19F2'1210, .size = 8, .data = {0x01, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}}};

/// 65294.
n2k::Frame autopilot(std::uint8_t follows, std::uint8_t source = kA) {
  return {.identifier = 0x0CFF'0E00U | source,
          .size = 8,
          .data = {0xFC, 0x9F, static_cast<std::uint8_t>(0xFCU | follows), 5, 0xFF, 0xFF, 0xFF, 0xFF}};
}

/// 65291, without an SNR or with 12.5 dB; deaf in bits 4 and 5 of byte 7.
n2k::Frame hydrophone(std::uint8_t deaf, bool has_snr, std::uint8_t source = kA) {
  n2k::Frame frame{.identifier = 0x14FF'0B00U | source, .size = 8, .data = {0xFC, 0x9F, 0xFF, 0xFF, 0xFD, 0xFF, 0xFF, 0xFF}};
  if (has_snr) {
    frame.data[2] = 0xE2;  // 1250 = 0x4E2; 18 bits, and two for "not too faint"
    frame.data[3] = 0x04;
    frame.data[4] = 0xF0;
  }
  frame.data[7] = static_cast<std::uint8_t>(0xCFU | (unsigned{deaf} << 4U));
  return frame;
}

class CanPortConditionsTest : public BusRig {
 protected:
  void bring(std::initializer_list<n2k::Frame> frames) {
    for (const n2k::Frame& frame : frames) send(frame);
    collect();
  }
  template <class Status>
  Status only() const {
    const std::vector<Status> all = taken_.all<Status>();
    EXPECT_EQ(all.size(), 1U);
    return all.empty() ? Status{} : all.front();
  }
  std::vector<bool> deafness() const {
    std::vector<bool> all;
    for (const auto& status : taken_.all<messages::HydrophoneStatus>()) all.push_back(status.is_deaf);
    return all;
  }
};

TEST_F(CanPortConditionsTest, MakesOneVehicleStatusOfWhatTheVehiclesDevicesSay) {
  open_settled();
  bring({altitude(), kCharge[0], kCharge[1], hull(kDry)});
  const auto status = only<messages::VehicleStatus>();
  EXPECT_EQ(status.altitude, Meters{42.5});
  EXPECT_EQ(status.battery_percent, 73.0);
  EXPECT_FALSE(status.has_leak);
  EXPECT_GT(status.time, Time{1'700'000'000'000'000}) << "the kernel's clock, which SetClock takes as it is";
  EXPECT_EQ(port_->report().received, 1U);
}

TEST_F(CanPortConditionsTest, TellsOfALeakAtOnceAndKeepsIt) {
  open_settled();
  bring({hull(kDry)});
  bring({hull(kWet)});
  bring({hull(kDry, kB)});
  clock_.time = clock_.time + Duration::seconds(60);
  bring({altitude()});
  const std::vector<messages::VehicleStatus> all = taken_.all<messages::VehicleStatus>();
  ASSERT_EQ(all.size(), 3U) << "another device's dryness waits for its second";
  EXPECT_FALSE(all[0].has_leak);
  EXPECT_TRUE(all[1].has_leak);
  EXPECT_TRUE(all[2].has_leak) << "the other device is dry";
}

TEST_F(CanPortConditionsTest, BringsWhetherTheAutopilotFollows) {
  open_settled();
  bring({autopilot(1)});
  EXPECT_TRUE(only<messages::AutopilotStatus>().follows_setpoints);
  taken_.values.clear();
  bring({autopilot(0)});
  EXPECT_FALSE(only<messages::AutopilotStatus>().follows_setpoints);
  taken_.values.clear();
  bring({autopilot(3), autopilot(2)});
  EXPECT_TRUE(taken_.values.empty());
  EXPECT_EQ(port_->report().malformed, 1U) << "\"error\"; \"not available\" is none";
}

TEST_F(CanPortConditionsTest, HearsOneAutopilotAtATimeAndTheOneWhoseNameIsGivenAlone) {
  open_settled();
  bring({autopilot(1, kA), autopilot(0, kB)});
  EXPECT_TRUE(only<messages::AutopilotStatus>().follows_setpoints);
  taken_.values.clear();
  settings_.n2k.autopilot_source.name = kNameOfB;
  open_settled();
  claim(kNameOfB, kB);
  bring({autopilot(1, kA), autopilot(0, kB)});
  EXPECT_FALSE(only<messages::AutopilotStatus>().follows_setpoints);
}

TEST_F(CanPortConditionsTest, BringsWhetherTheHydrophoneIsDeafBesideItsSnrOrWithoutOne) {
  open_settled();
  bring({hydrophone(3, true)});
  EXPECT_TRUE(deafness().empty()) << "it does not say";
  bring({hydrophone(0, true), hydrophone(1, false), hydrophone(2, false)});
  EXPECT_EQ(deafness(), (std::vector{false, true}));
  EXPECT_EQ(taken_.all<messages::SnrMeasurement>().size(), 2U);
  EXPECT_EQ(port_->report().malformed, 1U) << "\"error\"";
}

TEST_F(CanPortConditionsTest, LeavesAHydrophoneDeafThatDoesNotSayWhetherItStillIs) {
  open_settled();
  bring({hydrophone(1, true), hydrophone(3, true)});
  EXPECT_EQ(deafness(), std::vector{true});
}

TEST_F(CanPortConditionsTest, IsNotDeafAnyMoreWithAnotherHydrophoneInThePlaceOfADeafOne) {
  open_settled();
  bring({hydrophone(1, false, kA)});
  bring({hydrophone(3, true, kB)});
  EXPECT_EQ(deafness(), (std::vector{true, false}));
  bring({hydrophone(1, false, kA)});
  EXPECT_EQ(deafness(), (std::vector{true, false})) << "the SNR is the other's now";
}

TEST_F(CanPortConditionsTest, LeavesUnreadWhatItHasNoRoleFor) {
  settings_.roles = {Role::kOperator};
  open_settled();
  bring({altitude(), kCharge[0], kCharge[1], hull(kWet), autopilot(0), hydrophone(1, true)});
  EXPECT_TRUE(taken_.values.empty());
  settings_.roles = {Role::kNavigation};
  open_settled();
  bring({hull(kWet), autopilot(0), hydrophone(1, true)});
  EXPECT_EQ(taken_.values.size(), 1U) << "the leak";
  taken_.values.clear();
  settings_.roles = {Role::kAutopilot};
  open_settled();
  bring({hull(kWet), autopilot(0), hydrophone(1, true)});
  EXPECT_EQ(taken_.values.size(), 1U) << "the autopilot's";
}

}  // namespace
}  // namespace earshot::board
