#include "hil/nodes/emulated_vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "firmware/core/math.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "firmware/wire/n2k/table/messages.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"
#include "tests/hil/nodes/listening.hpp"

namespace earshot::hil {
namespace {

constexpr Time kSettled{3'000'000};  ///< everybody has an address, and has said everything once

VehicleSetup setup() {
  VehicleSetup setup;
  setup.start = {.position = {Meters{12'500}, Meters{3'000}}, .depth = Meters{300}, .heading = Radians{0.5}, .speed = MetersPerSecond{0}};
  setup.plane = n2k::LocalPlane::about({.latitude_deg = 38.5, .longitude_deg = -28.0}).value();
  setup.source = {.position = {Meters{12'500}, Meters{8'000}}, .snr = [](Meters range) { return Decibels{20.0 - range.value / 1e3}; }};
  setup.utc = [] { return Time{1'800'000'000'000'000}; };
  return setup;
}

void steer(EmulatedVehicle& vehicle, const messages::Setpoint& setpoint, Time now) {
  static std::uint8_t sequence = 0;
  n2k::SetpointFrames frames;
  ASSERT_EQ(n2k::compose_setpoint(setpoint, 0x40, sequence++, frames), Status::kOk);
  for (const n2k::Frame& frame : frames) vehicle.accept(frame, now);
}

/// Each frame's source and the group it bears.
std::map<std::uint8_t, std::set<std::uint32_t>> groups_by_source(const Frames& frames) {
  std::map<std::uint8_t, std::set<std::uint32_t>> groups;
  for (const n2k::Frame& frame : frames) {
    const n2k::Identifier identifier = n2k::parse_identifier(frame.identifier).value();
    groups[identifier.source].insert(identifier.pgn);
  }
  return groups;
}

TEST(EmulatedVehicle, IsTenDevicesEachWithAnAddressOfItsOwn) {
  EmulatedVehicle vehicle(setup());
  const Frames frames = run(vehicle, Time{}, kSettled);
  const auto groups = groups_by_source(frames);
  EXPECT_EQ(groups.size(), 10U);
  std::set<std::uint64_t> names;
  std::set<std::uint64_t> numbers;
  for (const n2k::Frame& claim : of_group(n2k::kAddressClaimPgn, frames)) {
    std::uint64_t name = 0;
    for (unsigned i = 0; i < 8; ++i) name |= std::uint64_t{claim.data[i]} << (8 * i);
    names.insert(name);
    numbers.insert(name & 0x1F'FFFFU);
  }
  EXPECT_EQ(names.size(), 10U);
  EXPECT_EQ(numbers.size(), 10U) << "of one maker, no two devices have the same";
  EXPECT_TRUE(groups.at(0x24).contains(n2k::kHeadingPgn));
  EXPECT_FALSE(groups.at(0x24).contains(n2k::kPositionPgn));
  EXPECT_TRUE(groups.at(0x27).contains(n2k::kPositionPgn));
  EXPECT_TRUE(groups.at(0x28).contains(n2k::kSnrPgn));
  EXPECT_TRUE(groups.at(0x2C).contains(n2k::kLeakPgn));
}

TEST(EmulatedVehicle, IsReadWhereItIs) {
  for (const std::optional<MagneticField> field : {std::optional<MagneticField>{}, std::optional(MagneticField{Radians{-0.2}})}) {
    VehicleSetup with = setup();
    with.magnetic_field = field;
    EmulatedVehicle vehicle(with);
    n2k::NavigationReceiver receiver(with.plane);
    n2k::Fix fix;
    int fixes = 0;
    for (Time now; now < Time{10'000'000}; now = now + Duration::milliseconds(100)) {
      if (now == kSettled)
        steer(vehicle, {.heading = Radians{1.0}, .speed = MetersPerSecond{2.0}, .depth = Meters{310.0}, .waypoint = {}}, now);
      Frames frames;
      vehicle.step(now, frames);
      for (const n2k::Frame& frame : frames) {
        if (receiver.accept(frame, now, fix) != Status::kOk) continue;
        ++fixes;
        // 1e-7 degree is 11 mm of latitude, 9 mm of longitude here: half of each.
        EXPECT_NEAR(fix.position.north.value, vehicle.state().position.north.value, 0.006);
        EXPECT_NEAR(fix.position.east.value, vehicle.state().position.east.value, 0.006);
        // Half of 1e-4 rad; half once more for the variation's, and a hair for a whole turn, which is no whole number of them.
        EXPECT_NEAR(fix.heading.value, vehicle.state().heading.value, 1.1e-4);
        // It dives 0.5 m/s, and its pressure is up to two seconds old.
        EXPECT_NEAR(fix.depth.value, vehicle.state().depth.value, 1.0 + 1e-5);
        // It gathers way with 2 m/s in 5 s, and its speed is up to a second old.
        EXPECT_NEAR(fix.speed->value, vehicle.state().speed.value, 0.4);
      }
    }
    // In the first 300 ms it has no address yet; then ten a second.
    EXPECT_EQ(fixes, 97);
    EXPECT_EQ(receiver.counters().refused, 0U);
  }
}

TEST(EmulatedVehicle, SailsAsItsAutopilotIsTold) {
  EmulatedVehicle vehicle(setup());
  (void)run(vehicle, Time{}, kSettled);
  for (std::int64_t s = 0; s < 100; ++s) {
    const Time now = kSettled + Duration::seconds(s);
    steer(vehicle, {.heading = Radians{1.5707963}, .speed = MetersPerSecond{2.0}, .depth = Meters{310.0}, .waypoint = {}}, now);
    (void)run(vehicle, now, now + Duration::seconds(1));
  }
  // East at 2 m/s for 100 s, less 2 m/s x 5 s that it takes to gather way; a turn of a right angle from 0.5 rad takes 10 s at 6 degrees a
  // second while it is slow.
  EXPECT_NEAR(vehicle.state().position.east.value, 3'000.0 + 190.0, 10.0);
  EXPECT_NEAR(vehicle.state().position.north.value, 12'500.0, 15.0);
  EXPECT_NEAR(vehicle.state().depth.value, 310.0, 1e-9);
  EXPECT_NEAR(vehicle.sailed().value, 190.0, 1.0);
  EXPECT_NEAR(vehicle.battery_percent(), 100.0 - 0.19 * 0.6, 0.001);
}

TEST(EmulatedVehicle, HearsTheSourceLouderAsItComesNearer) {
  EmulatedVehicle vehicle(setup());
  const Frames before = of_group(n2k::kSnrPgn, run(vehicle, Time{}, kSettled));
  ASSERT_FALSE(before.empty());
  EXPECT_NEAR(n2k::read_snr(before.back().bytes()).value().snr.value, 15.0, 0.005);
  EXPECT_NEAR(vehicle.range().value, 5000.0, 1e-9);
}

TEST(EmulatedVehicle, LeavesOutWhatIsThereAsHardware) {
  VehicleSetup with = setup();
  with.without = {"compass", "operator", "autopilot"};
  EmulatedVehicle vehicle(with);
  const Frames frames = run(vehicle, Time{}, kSettled);
  EXPECT_EQ(vehicle.devices(), (std::vector<std::string_view>{"speed log", "depth sensor", "inertial navigation", "hydrophone", "altimeter",
                                                              "battery", "hull monitor"}));
  EXPECT_TRUE(of_group(n2k::kHeadingPgn, frames).empty());
  EXPECT_EQ(vehicle.autopilot(), nullptr);
  EXPECT_EQ(vehicle.operator_ashore(), nullptr);
  EXPECT_FALSE(vehicle.address_of("compass").has_value());
  EXPECT_EQ(vehicle.address_of("speed-log"), 0x25);
}

TEST(EmulatedVehicle, KnowsTheAddressOfADeviceWhenItHasOne) {
  EmulatedVehicle vehicle(setup());
  EXPECT_FALSE(vehicle.address_of("hull-monitor").has_value());
  (void)run(vehicle, Time{}, kSettled);
  EXPECT_EQ(vehicle.address_of("autopilot"), 0x23);
  EXPECT_EQ(vehicle.address_of("hull-monitor"), 0x2C);
  EXPECT_FALSE(vehicle.address_of("echo-sounder").has_value());
}

TEST(EmulatedVehicle, LetsItsDevicesHearEachOther) {
  VehicleSetup with = setup();
  EmulatedVehicle vehicle(with);
  (void)run(vehicle, Time{}, kSettled);
  // Somebody with the lowest of all NAMEs takes the compass's address. The compass takes the next, which is the speed log's, whose NAME is
  // higher (function 155 against 140): that moves on, too, to one that is free.
  vehicle.accept({.identifier = 0x18EEFF24, .size = 8, .data = {}}, kSettled);
  (void)run(vehicle, kSettled, kSettled + Duration::seconds(3));
  const Time later = kSettled + Duration::seconds(3);
  const auto groups = groups_by_source(run(vehicle, later, later + Duration::seconds(3)));
  EXPECT_EQ(groups.size(), 9U) << "the autopilot and the eight that measure; the operator has nothing to say";
  EXPECT_FALSE(groups.contains(0x24));
  EXPECT_TRUE(groups.at(0x25).contains(n2k::kHeadingPgn));
}

}  // namespace
}  // namespace earshot::hil
