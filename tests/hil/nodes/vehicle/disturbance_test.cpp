#include "hil/nodes/vehicle/disturbance.hpp"

#include <gtest/gtest.h>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "firmware/wire/n2k/table/messages.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"
#include "hil/nodes/emulated_vehicle.hpp"
#include "tests/hil/nodes/listening.hpp"

namespace earshot::hil {
namespace {

constexpr double kEast = 1.5707963267948966;
/// Half of what its messages round: a position 1e-7 degree, a heading 1e-4 rad.
constexpr double kPlace_m = 0.006;
constexpr double kHeading_rad = 0.6e-4;

/// A vehicle that sails east at 2 m/s in 300 m, over a sea floor of 450 m, 5 km from the source, and has done so for 4 s.
class DisturbanceTest : public testing::Test {
 protected:
  DisturbanceTest() { sail(4); }

  static VehicleSetup setup() {
    VehicleSetup setup;
    setup.start = {.position = {}, .depth = Meters{300}, .heading = Radians{kEast}, .speed = MetersPerSecond{2}};
    setup.plane = n2k::LocalPlane::about({.latitude_deg = 38.5, .longitude_deg = -28.0}).value();
    setup.source = {.position = {Meters{0}, Meters{5'000}}, .snr = [](Meters range) { return Decibels{20.0 - range.value / 1e3}; }};
    setup.sea_floor = {.depth = Meters{450}, .reach = Meters{200}};
    setup.without = {"operator"};
    return setup;
  }

  void sail(std::int64_t seconds) {
    said_.clear();
    for (const Time end = now_ + Duration::seconds(seconds); now_ < end; now_ = now_ + Duration::milliseconds(100)) {
      Frames frames;
      vehicle_.step(now_, frames);
      for (const n2k::Frame& frame : frames) (void)receiver_.accept(frame, now_, fix_);
      said_.insert(said_.end(), frames.begin(), frames.end());
    }
  }
  /// Told once a second, as by Earshot.
  void steer(std::int64_t seconds, double heading_rad, double depth_m = 300.0) {
    Frames said;
    for (std::int64_t s = 0; s < seconds; ++s) {
      n2k::SetpointFrames frames;
      ASSERT_EQ(
          n2k::compose_setpoint({.heading = Radians{heading_rad}, .speed = MetersPerSecond{2.0}, .depth = Meters{depth_m}, .waypoint = {}},
                                0x40, sequence_++, frames),
          Status::kOk);
      for (const n2k::Frame& frame : frames) vehicle_.accept(frame, now_);
      sail(1);
      said.insert(said.end(), said_.begin(), said_.end());
    }
    said_ = said;
  }
  /// The last of a group that was said on the last way.
  [[nodiscard]] n2k::Frame last(std::uint32_t pgn) const {
    const Frames frames = of_group(pgn, said_);
    EXPECT_FALSE(frames.empty()) << pgn;
    return frames.empty() ? n2k::Frame{} : frames.back();
  }
  [[nodiscard]] double altitude() const { return n2k::read(n2k::kWaterDepthPgn, "Depth", last(n2k::kWaterDepthPgn).bytes()).value(); }

  EmulatedVehicle vehicle_{setup()};
  n2k::NavigationReceiver receiver_{setup().plane};
  n2k::Fix fix_;
  Frames said_;
  Time now_;
  std::uint8_t sequence_ = 0;
};

TEST_F(DisturbanceTest, ACurrentCarriesTheVehicleOverGroundAndCostsItNothing) {
  const NorthEast before = vehicle_.state().position;
  const Meters sailed = vehicle_.sailed();
  vehicle_.disturb({.current_mps = {Meters{0.3}, Meters{-0.5}}});
  sail(100);
  EXPECT_NEAR((vehicle_.state().position - before).north.value, 30.0, 1e-6);
  EXPECT_NEAR((vehicle_.state().position - before).east.value, 150.0, 1e-6) << "100 s x (2 - 0.5) m/s";
  EXPECT_NEAR((vehicle_.sailed() - sailed).value, 200.0, 1e-6) << "through the water";
  EXPECT_EQ(vehicle_.state().heading.value, kEast);
  EXPECT_NEAR(fix_.position.north.value, vehicle_.state().position.north.value, kPlace_m) << "navigation knows";
}

TEST_F(DisturbanceTest, ARudderThatIsStuckAmidshipsKeepsTheVehicleOnItsCourse) {
  vehicle_.disturb({.is_rudder_stuck = true});
  steer(60, 0.0);
  EXPECT_EQ(vehicle_.state().heading.value, kEast);
  EXPECT_NEAR(fix_.heading.value, kEast, kHeading_rad);
  vehicle_.disturb({});
  steer(60, 0.0);
  EXPECT_NEAR(vehicle_.state().heading.value, 0.0, kHeading_rad) << "it is free again";
}

TEST_F(DisturbanceTest, ARudderThatIsStuckInATurnLetsTheVehicleGoRoundToThatSide) {
  for (const double side : {1.0, -1.0}) {
    vehicle_.disturb({});
    steer(60, kEast);
    steer(3, kEast + side * 1.5);
    const vehicle::State before = vehicle_.state();
    vehicle_.disturb({.is_rudder_stuck = true});
    steer(15, kEast);
    // 15 s at 6 degrees a second are a right angle.
    EXPECT_NEAR(vehicle_.state().heading.value, before.heading.value + side * 1.5707963 + (side > 0 ? -6.2831853 : 0.0), 1e-5) << side;
    steer(15, kEast);
    // Half a circle of 2 m/s / 0.10472 rad/s = 19.1 m radius.
    EXPECT_NEAR(range_between(before.position, vehicle_.state().position).value, 38.2, 0.1);
    steer(30, kEast);
    EXPECT_NEAR(range_between(before.position, vehicle_.state().position).value, 0.0, 0.1);
  }
}

TEST_F(DisturbanceTest, PlanesThatAreStuckKeepTheDepth) {
  vehicle_.disturb({.are_planes_stuck = true});
  steer(30, kEast, 310.0);
  EXPECT_EQ(vehicle_.state().depth.value, 300.0);
  vehicle_.disturb({});
  steer(30, kEast, 310.0);
  EXPECT_NEAR(vehicle_.state().depth.value, 310.0, 1e-9);
}

TEST_F(DisturbanceTest, AVehicleThatNeedsSpeedKeepsItsDepthWhileItIsSlower) {
  vehicle_.disturb({.steerage_way = MetersPerSecond{2.5}});
  steer(30, kEast, 310.0);
  EXPECT_EQ(vehicle_.state().depth.value, 300.0) << "at 2 m/s";
  vehicle_.disturb({.steerage_way = MetersPerSecond{1.5}});
  steer(30, kEast, 310.0);
  EXPECT_NEAR(vehicle_.state().depth.value, 310.0, 1e-9);
}

TEST_F(DisturbanceTest, WithoutThrustTheVehicleComesToRest) {
  const double before = vehicle_.state().position.east.value;
  vehicle_.disturb({.has_no_thrust = true});
  steer(60, kEast);
  // Of 5 s of lag, in steps of 0.1 s: 2 % less in each, and the mean of a step is 1 % less than its beginning: 2 m/s x 0.1 s x 0.99 / 0.02.
  EXPECT_NEAR(vehicle_.state().position.east.value - before, 9.9, 1e-3);
  EXPECT_NEAR(vehicle_.state().speed.value, 0.0, 1e-4);
  EXPECT_EQ(fix_.speed->value, 0.0);
}

TEST_F(DisturbanceTest, AnAutopilotThatIsDisengagedFollowsNoSetPointAndSaysSo) {
  vehicle_.disturb({.is_disengaged = true});
  steer(20, 0.0);
  EXPECT_EQ(vehicle_.state().heading.value, kEast);
  EXPECT_FALSE(n2k::read_autopilot_status(last(n2k::kAutopilotStatusPgn).bytes()).value().follows_setpoints);
  vehicle_.disturb({});
  steer(20, 0.0);
  EXPECT_NEAR(vehicle_.state().heading.value, 0.0, kHeading_rad);
  EXPECT_TRUE(n2k::read_autopilot_status(last(n2k::kAutopilotStatusPgn).bytes()).value().follows_setpoints);
}

TEST_F(DisturbanceTest, AnObstinateAutopilotFollowsNoSetPointAndSaysThatItDoes) {
  vehicle_.disturb({.is_obstinate = true});
  steer(20, 0.0);
  EXPECT_EQ(vehicle_.state().heading.value, kEast);
  EXPECT_TRUE(n2k::read_autopilot_status(last(n2k::kAutopilotStatusPgn).bytes()).value().follows_setpoints);
}

TEST_F(DisturbanceTest, ABatteryThatHasLostItsChargeGoesOnToFall) {
  vehicle_.disturb({.battery_percent = 30.0});
  sail(500);
  // 0.6 % for the kilometre that it sails.
  EXPECT_NEAR(vehicle_.battery_percent(), 29.4, 1e-6);
  const Frames charges = of_group(n2k::kChargePgn, said_);
  ASSERT_GE(charges.size(), 2U);
  const bool is_first = (charges.back().data[0] & 0x1FU) == 0;
  EXPECT_EQ((is_first ? charges.back() : charges[charges.size() - 2]).data[5], 29) << "in whole percent";
  vehicle_.disturb({});
  sail(1);
  EXPECT_LT(vehicle_.battery_percent(), 29.4) << "nobody charges it";
}

TEST_F(DisturbanceTest, TheHullSaysThatItIsWetOrHasAGroundFault) {
  EXPECT_FALSE(n2k::read_hull(last(n2k::kLeakPgn).bytes()).value().wet.value());
  vehicle_.disturb({.hull = {.instance = 0, .wet = true, .has_ground_fault = false}});
  sail(2);
  EXPECT_TRUE(n2k::read_hull(last(n2k::kLeakPgn).bytes()).value().wet.value());
  EXPECT_FALSE(n2k::read_hull(last(n2k::kLeakPgn).bytes()).value().has_ground_fault.value());
  vehicle_.disturb({.hull = {.instance = 0, .wet = false, .has_ground_fault = true}});
  sail(2);
  EXPECT_FALSE(n2k::read_hull(last(n2k::kLeakPgn).bytes()).value().wet.value());
  EXPECT_TRUE(n2k::read_hull(last(n2k::kLeakPgn).bytes()).value().has_ground_fault.value());
}

TEST_F(DisturbanceTest, TheAltimeterAloneKnowsThatTheSeaFloorIsNearer) {
  EXPECT_NEAR(altitude(), 150.0, 0.005);
  vehicle_.disturb({.floor_rise = Meters{120}});
  sail(2);
  EXPECT_NEAR(altitude(), 30.0, 0.005);
  EXPECT_NEAR(fix_.depth.value, 300.0, 1e-5);
}

TEST_F(DisturbanceTest, FrozenInstrumentsGoOnTellingWhatTheyTold) {
  const n2k::Fix before = fix_;
  vehicle_.disturb({.is_frozen = true});
  steer(60, 0.0, 310.0);
  EXPECT_EQ(fix_.position.north.value, before.position.north.value);
  EXPECT_EQ(fix_.position.east.value, before.position.east.value);
  EXPECT_EQ(fix_.heading.value, before.heading.value);
  EXPECT_EQ(fix_.depth.value, before.depth.value);
  EXPECT_EQ(of_group(n2k::kPositionPgn, said_).size(), 600U) << "they are not silent";
  EXPECT_NEAR(vehicle_.state().heading.value, 0.0, kHeading_rad) << "the vehicle sails";
  EXPECT_NEAR(altitude(), 140.0, 0.005) << "the altimeter is not one of them";
  vehicle_.disturb({});
  steer(3, 0.0, 310.0);
  EXPECT_NEAR(fix_.position.north.value, vehicle_.state().position.north.value, kPlace_m);
}

TEST_F(DisturbanceTest, NavigationTellsAPlaceBesideTheTrueOne) {
  vehicle_.disturb({.position_error = {Meters{300}, Meters{-400}}});
  sail(1);
  EXPECT_NEAR((fix_.position - vehicle_.state().position).north.value, 300.0, kPlace_m);
  EXPECT_NEAR((fix_.position - vehicle_.state().position).east.value, -400.0, kPlace_m);
  EXPECT_NEAR(vehicle_.state().position.north.value, 0.0, 1e-9) << "it is where it was";
  const double snr = n2k::read_snr(last(n2k::kSnrPgn).bytes()).value().snr.value;
  EXPECT_NEAR(snr, 20.0 - vehicle_.range().value / 1e3, 0.02) << "and hears from there";
}

TEST_F(DisturbanceTest, TheCompassTellsAnotherHeading) {
  vehicle_.disturb({.heading_error = Radians{-0.25}});
  sail(1);
  EXPECT_NEAR(fix_.heading.value, kEast - 0.25, kHeading_rad);
  EXPECT_EQ(vehicle_.state().heading.value, kEast);
}

TEST_F(DisturbanceTest, TheDepthSensorTellsAnotherDepth) {
  vehicle_.disturb({.depth_error = Meters{-20}});
  sail(3);
  EXPECT_NEAR(fix_.depth.value, 280.0, 1e-5);
  EXPECT_EQ(vehicle_.state().depth.value, 300.0);
  EXPECT_NEAR(altitude(), 150.0, 0.005);
}

TEST_F(DisturbanceTest, TheHydrophoneIsDeafOrWrongByItsGain) {
  vehicle_.disturb({.hydrophone = {.is_deaf = true, .gain_error = {}}});
  sail(2);
  EXPECT_TRUE(n2k::read_deaf(last(n2k::kSnrPgn).bytes()).value());
  vehicle_.disturb({.hydrophone = {.is_deaf = false, .gain_error = Decibels{-6}}});
  sail(2);
  // 20 dB less one for each of 4.99 km less 6.
  EXPECT_NEAR(n2k::read_snr(last(n2k::kSnrPgn).bytes()).value().snr.value, 9.0, 0.03);
}

}  // namespace
}  // namespace earshot::hil
