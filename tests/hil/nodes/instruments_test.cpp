#include "hil/nodes/instruments.hpp"

#include <gtest/gtest.h>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/hil/nodes/listening.hpp"

namespace earshot::hil {
namespace {

constexpr double kHalfPi = 1.5707963267948966;
constexpr Time kSettled{1'000'000};

vehicle::State heading_west() {
  return {.position = {Meters{1000}, Meters{-2000}}, .depth = Meters{300}, .heading = Radians{-kHalfPi}, .speed = MetersPerSecond{2.0}};
}

/// What it sends in the first ten seconds after the one in which it gets its address.
Frames ten_seconds_of(Sensor& sensor) {
  (void)run(sensor, Time{}, kSettled);
  return run(sensor, kSettled, kSettled + Duration::seconds(10));
}

TEST(Instruments, AGyrocompassShowsTheTrueHeadingTenTimesASecond) {
  const vehicle::State vehicle = heading_west();
  const auto compass = make_compass(vehicle, {}, 1);
  const Frames frames = ten_seconds_of(*compass);
  const Frames headings = of_group(n2k::kHeadingPgn, frames);
  ASSERT_EQ(headings.size(), 100U);
  EXPECT_EQ(of_group(n2k::kVariationPgn, frames).size(), 0U);
  // 127250 = 0x1F112 at priority 2 from 0x24. West is 3/2 pi = 47124 = 0xB814 of 1e-4 rad; no deviation, no variation; true: 0 in two bits.
  const std::uint8_t sid = headings[0].data[0];
  EXPECT_EQ(headings[0], (n2k::Frame{0x09F11224, 8, {sid, 0x14, 0xB8, 0xFF, 0x7F, 0xFF, 0x7F, 0xFC}}));
  EXPECT_EQ(headings[1].data[0], sid + 1);
}

TEST(Instruments, AMagneticCompassShowsTheHeadingLessTheVariationWhichItSays) {
  const vehicle::State vehicle = heading_west();
  const auto compass = make_compass(vehicle, MagneticField{Radians{0.1}}, 1);
  const Frames frames = ten_seconds_of(*compass);
  const Frames headings = of_group(n2k::kHeadingPgn, frames);
  const Frames variations = of_group(n2k::kVariationPgn, frames);
  ASSERT_EQ(headings.size(), 100U);
  ASSERT_EQ(variations.size(), 10U);
  // 47124 - 1000 = 46124 = 0xB42C; magnetic: 1.
  EXPECT_EQ(headings[0].data[1], 0x2C);
  EXPECT_EQ(headings[0].data[2], 0xB4);
  EXPECT_EQ(headings[0].data[7], 0xFD);
  // 127258 = 0x1F11A at priority 7: source 0 (manual) and four reserved bits, no age, 1000 = 0x03E8 east.
  EXPECT_EQ(variations[0], (n2k::Frame{0x1DF11A24, 8, {variations[0].data[0], 0xF0, 0xFF, 0xFF, 0xE8, 0x03, 0xFF, 0xFF}}));
}

TEST(Instruments, ACompassMeasuresTheRateOfTurnByTheShorterWay) {
  vehicle::State vehicle = heading_west();
  vehicle.heading = Radians{3.14};
  const auto compass = make_compass(vehicle, {}, 1);
  (void)run(*compass, Time{}, kSettled);
  (void)run(*compass, kSettled, kSettled + Duration::milliseconds(100));
  vehicle.heading = Radians{-3.14};  // 2 pi - 6.28 = 0.0031853 rad further to starboard
  const Frames turns =
      of_group(n2k::kRateOfTurnPgn, run(*compass, kSettled + Duration::milliseconds(100), kSettled + Duration::milliseconds(200)));
  ASSERT_EQ(turns.size(), 1U);
  const Result<double> rate = n2k::read(n2k::kRateOfTurnPgn, "Rate", turns[0].bytes());
  ASSERT_TRUE(rate.ok());
  EXPECT_NEAR(rate.value(), 0.031853, 1e-6);
}

TEST(Instruments, ASpeedLogSaysTheSpeedThroughTheWaterOnceASecond) {
  const vehicle::State vehicle = heading_west();
  const auto log = make_speed_log(vehicle, 1);
  const Frames speeds = of_group(n2k::kSpeedPgn, ten_seconds_of(*log));
  ASSERT_EQ(speeds.size(), 10U);
  // 128259 = 0x1F503 at priority 2 from 0x25: 200 = 0xC8 of 0.01 m/s, ground unknown, Doppler (2), direction unknown.
  EXPECT_EQ(speeds[0], (n2k::Frame{0x09F50325, 8, {speeds[0].data[0], 0xC8, 0x00, 0xFF, 0xFF, 0x02, 0xFF, 0xFF}}));
}

TEST(Instruments, ADepthSensorSaysThePressureOfTheWaterEveryTwoSeconds) {
  const vehicle::State vehicle = heading_west();
  const auto sensor = make_depth_sensor(vehicle, 1);
  const Frames pressures = of_group(n2k::kPressurePgn, ten_seconds_of(*sensor));
  ASSERT_EQ(pressures.size(), 5U);
  // 130314 = 0x1FD0A at priority 5 from 0x26: instance 0, water (1). 300 m x 1025 kg/m3 x 9.80665 m/s2 = 3015544.875 Pa: 30155449 =
  // 0x01CC22B9.
  EXPECT_EQ(pressures[0], (n2k::Frame{0x15FD0A26, 8, {pressures[0].data[0], 0x00, 0x01, 0xB9, 0x22, 0xCC, 0x01, 0xFF}}));
}

TEST(Instruments, AnAltimeterSaysTheHeightOverTheSeaFloorOnceASecondAndNoneOutOfItsReach) {
  vehicle::State vehicle = heading_west();
  const auto altimeter = make_altimeter(vehicle, {.depth = Meters{342.5}, .reach = Meters{42.5}}, 1);
  const Frames altitudes = of_group(n2k::kWaterDepthPgn, ten_seconds_of(*altimeter));
  ASSERT_EQ(altitudes.size(), 10U);
  // 128267 = 0x1F50B at priority 3 from 0x2A: 4250 = 0x109A of 0.01 m, no offset, range not available.
  EXPECT_EQ(altitudes[0], (n2k::Frame{0x0DF50B2A, 8, {altitudes[0].data[0], 0x9A, 0x10, 0x00, 0x00, 0x00, 0x00, 0xFF}}));
  vehicle.depth = Meters{299.99};
  const Time later = kSettled + Duration::seconds(10);
  const Frames none = of_group(n2k::kWaterDepthPgn, run(*altimeter, later, later + Duration::seconds(1)));
  ASSERT_EQ(none.size(), 1U);
  EXPECT_EQ(none[0], (n2k::Frame{0x0DF50B2A, 8, {none[0].data[0], 0xFF, 0xFF, 0xFF, 0xFF, 0x00, 0x00, 0xFF}}));
}

TEST(Instruments, ABatterySaysItsChargeInPercentEveryOneAndAHalfSeconds) {
  const double percent = 72.6;
  const auto battery = make_battery(percent, 1);
  const Frames frames = of_group(n2k::kChargePgn, ten_seconds_of(*battery));
  ASSERT_GE(frames.size(), 2U * 6U);
  ASSERT_LE(frames.size(), 2U * 7U);
  // 127506 = 0x1F212 at priority 6 from 0x2B: 11 bytes, instance 0, a battery (0), 73 %.
  EXPECT_EQ(frames[0].identifier, 0x19F2122BU);
  EXPECT_EQ(frames[0].data[1], 11);
  EXPECT_EQ(frames[0].data[3], 0);
  EXPECT_EQ(frames[0].data[4], 0);
  EXPECT_EQ(frames[0].data[5], 73);
}

TEST(Instruments, AHullMonitorSaysOnceASecondWhetherTheHullIsWetAndHasAGroundFault) {
  n2k::Hull hull{.instance = 0, .wet = false, .has_ground_fault = false};
  const auto monitor = make_hull_monitor(hull, 1);
  const Frames frames = of_group(n2k::kLeakPgn, ten_seconds_of(*monitor));
  ASSERT_EQ(frames.size(), 10U);
  // 65293 = 0xFF0D at priority 1 from 0x2C: maker and industry 0x9FFC, instance 0, dry (0) and none (0) in two bits each, reserved ones.
  EXPECT_EQ(frames[0], (n2k::Frame{0x04FF0D2C, 8, {0xFC, 0x9F, 0x00, 0xF0, 0xFF, 0xFF, 0xFF, 0xFF}}));
  hull.wet = true;
  const Time later = kSettled + Duration::seconds(10);
  EXPECT_EQ(of_group(n2k::kLeakPgn, run(*monitor, later, later + Duration::seconds(1))).at(0).data[3], 0xF1);
  hull = {.instance = 0, .wet = false, .has_ground_fault = true};
  const Time last = later + Duration::seconds(1);
  EXPECT_EQ(of_group(n2k::kLeakPgn, run(*monitor, last, last + Duration::seconds(1))).at(0).data[3], 0xF4);
}

TEST(Instruments, NavigationSaysThePositionTenTimesASecondAndTheWholeFixOnce) {
  const vehicle::State vehicle = heading_west();
  const n2k::LocalPlane plane = n2k::LocalPlane::about({.latitude_deg = 38.5, .longitude_deg = -28.0}).value();
  const auto navigation = make_navigation(vehicle, plane, 1);
  const Frames frames = ten_seconds_of(*navigation);
  const Frames positions = of_group(n2k::kPositionPgn, frames);
  ASSERT_EQ(positions.size(), 100U);
  EXPECT_EQ(of_group(n2k::kCoursePgn, frames).size(), 40U);
  // By GeographicLib: the geodesic of 2236.068 m from 38.5, -28 whose azimuth is -63.434949 degrees in its middle; 1e-7 degree is what the
  // message can tell apart.
  EXPECT_NEAR(n2k::read(n2k::kPositionPgn, "Latitude", positions[0].bytes()).value(), 38.509008519, 1e-7);
  EXPECT_NEAR(n2k::read(n2k::kPositionPgn, "Longitude", positions[0].bytes()).value(), -28.022928593, 1e-7);
  n2k::FastPacketAssembly assembly;
  std::span<const std::uint8_t> fix;
  for (const n2k::Frame& frame : of_group(n2k::kGnssPgn, frames))
    (void)assembly.accept(n2k::parse_identifier(frame.identifier).value(), frame, fix);
  EXPECT_NEAR(n2k::read(n2k::kGnssPgn, "Latitude", fix).value(), 38.509008519, 1e-7);
  EXPECT_NEAR(n2k::read(n2k::kGnssPgn, "Longitude", fix).value(), -28.022928593, 1e-7);
}

TEST(Instruments, AFixIsEstimatedDatedAndBelowTheSea) {
  const vehicle::State vehicle = heading_west();
  const auto navigation = make_navigation(vehicle, n2k::LocalPlane{}, 1);
  // 2026-11-23 06:00:00 UTC is 20780 days and 21600 s after the epoch.
  const Time began = Time{} + Duration::seconds(std::int64_t{20'780} * 86'400 + 21'600);
  (void)run(*navigation, began + Duration::milliseconds(-1000), began);
  const Frames frames = of_group(n2k::kGnssPgn, run(*navigation, began, began + Duration::seconds(1)));
  ASSERT_EQ(frames.size(), 7U) << "43 bytes";
  n2k::FastPacketAssembly assembly;
  std::span<const std::uint8_t> bytes;
  for (const n2k::Frame& frame : frames) (void)assembly.accept(n2k::parse_identifier(frame.identifier).value(), frame, bytes);
  ASSERT_EQ(bytes.size(), 43U);
  EXPECT_EQ(n2k::read(n2k::kGnssPgn, "Date", bytes).value(), 20'780.0);
  EXPECT_NEAR(n2k::read(n2k::kGnssPgn, "Time", bytes).value(), 21'600.0, 1.0);
  EXPECT_EQ(n2k::read(n2k::kGnssPgn, "Method", bytes).value(), 6.0) << "estimated (dead reckoning)";
  EXPECT_EQ(n2k::read(n2k::kGnssPgn, "Altitude", bytes).value(), -300.0);
}

TEST(Instruments, NavigationBeyondItsPlaneSaysNoPosition) {
  vehicle::State vehicle = heading_west();
  vehicle.position.north = Meters{1e6};
  const auto navigation = make_navigation(vehicle, n2k::LocalPlane{}, 1);
  const Frames frames = ten_seconds_of(*navigation);
  EXPECT_TRUE(of_group(n2k::kPositionPgn, frames).empty());
  EXPECT_EQ(of_group(n2k::kCoursePgn, frames).size(), 40U);
  EXPECT_GT(navigation->unsent(), 100U);
}

}  // namespace
}  // namespace earshot::hil
