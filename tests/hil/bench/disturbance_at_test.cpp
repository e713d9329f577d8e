#include "hil/bench/disturbance_at.hpp"

#include <gtest/gtest.h>

#include "tests/hil/seconds.hpp"

namespace earshot::hil {
namespace {

constexpr Duration kTick = Duration::seconds(1);

Disturbance of(Fault fault, double amount = 0.0, double direction_deg = 0.0) {
  return disturbance_at({{.fault = fault, .from = at_s(10), .amount = amount, .direction_deg = direction_deg}}, at_s(10), kTick);
}

TEST(DisturbanceAt, IsWhatTheFaultSays) {
  EXPECT_TRUE(of(Fault::kRudderStuck).is_rudder_stuck);
  EXPECT_TRUE(of(Fault::kPlanesStuck).are_planes_stuck);
  EXPECT_TRUE(of(Fault::kNoThrust).has_no_thrust);
  EXPECT_TRUE(of(Fault::kDisengaged).is_disengaged);
  EXPECT_TRUE(of(Fault::kObstinate).is_obstinate);
  EXPECT_EQ(of(Fault::kSteerageWay, 0.5).steerage_way, MetersPerSecond{0.5});
  EXPECT_EQ(of(Fault::kCurrent, 0.5, 0.0).current_mps.north.value, 0.5);
  EXPECT_EQ(of(Fault::kBattery, 30.0).battery_percent, 30.0);
  EXPECT_EQ(of(Fault::kLeak).hull.wet, true);
  EXPECT_EQ(of(Fault::kLeak).hull.has_ground_fault, false);
  EXPECT_EQ(of(Fault::kGroundFault).hull.has_ground_fault, true);
  EXPECT_EQ(of(Fault::kGroundFault).hull.wet, false);
  EXPECT_EQ(of(Fault::kFloorRise, 120.0).floor_rise.value, 120.0);
  EXPECT_TRUE(of(Fault::kFrozen).is_frozen);
  EXPECT_NEAR(of(Fault::kPositionError, 300.0, 90.0).position_error.east.value, 300.0, 1e-9);
  EXPECT_NEAR(of(Fault::kHeadingError, -90.0).heading_error.value, -1.5707963267948966, 1e-15);
  EXPECT_EQ(of(Fault::kDepthError, -20.0).depth_error.value, -20.0);
  EXPECT_TRUE(of(Fault::kDeaf).hydrophone.is_deaf);
  EXPECT_EQ(of(Fault::kGainError, -12.0).hydrophone.gain_error.value, -12.0);
}

TEST(DisturbanceAt, IsMadeOfEveryFaultOfTheVehicle) {
  for (const FaultTraits& traits : kFaultTraits) EXPECT_NO_THROW((void)of(traits.fault)) << traits.word;
}

TEST(DisturbanceAt, IsNothingBeforeAndBehindItsTime) {
  const std::vector<TimedFault> faults{{.fault = Fault::kFrozen, .from = at_s(10), .until = at_s(12)}};
  EXPECT_FALSE(disturbance_at(faults, at_s(9), kTick).is_frozen);
  EXPECT_TRUE(disturbance_at(faults, at_s(11), kTick).is_frozen);
  EXPECT_FALSE(disturbance_at(faults, at_s(12), kTick).is_frozen);
}

TEST(DisturbanceAt, AddsUpErrorsOfOneKind) {
  const std::vector<TimedFault> faults{{.fault = Fault::kCurrent, .from = at_s(0), .amount = 0.3, .direction_deg = 0.0},
                                       {.fault = Fault::kCurrent, .from = at_s(0), .amount = 0.4, .direction_deg = 90.0},
                                       {.fault = Fault::kDepthError, .from = at_s(0), .amount = 5.0},
                                       {.fault = Fault::kDepthError, .from = at_s(0), .amount = -7.0},
                                       {.fault = Fault::kGainError, .from = at_s(0), .amount = 3.0},
                                       {.fault = Fault::kGainError, .from = at_s(0), .amount = 3.0},
                                       {.fault = Fault::kFloorRise, .from = at_s(0), .amount = 40.0},
                                       {.fault = Fault::kFloorRise, .from = at_s(0), .amount = 2.0},
                                       {.fault = Fault::kPositionError, .from = at_s(0), .amount = 30.0, .direction_deg = 0.0},
                                       {.fault = Fault::kPositionError, .from = at_s(0), .amount = 50.0, .direction_deg = 0.0}};
  const Disturbance d = disturbance_at(faults, at_s(5), kTick);
  EXPECT_NEAR(d.current_mps.north.value, 0.3, 1e-12);
  EXPECT_NEAR(d.current_mps.east.value, 0.4, 1e-12);
  EXPECT_EQ(d.depth_error.value, -2.0);
  EXPECT_EQ(d.hydrophone.gain_error.value, 6.0);
  EXPECT_EQ(d.floor_rise.value, 42.0);
  EXPECT_NEAR(d.position_error.north.value, 80.0, 1e-12);
}

TEST(DisturbanceAt, TakesTheBatterysChargeOnceThoughItLastsToTheEnd) {
  const std::vector<TimedFault> faults{{.fault = Fault::kBattery, .from = Time{10'500'000}, .amount = 30.0}};
  int taken = 0;
  for (std::int64_t s = 0; s < 100; ++s) taken += disturbance_at(faults, at_s(s), kTick).battery_percent ? 1 : 0;
  EXPECT_EQ(taken, 1);
}

// 3 m/s eastwards for 10 s, and 0.2 m/s upwards; a log that says half a metre a second too much.
TEST(DisturbanceAt, LetsWhatDriftsGoOnDrifting) {
  const std::vector<TimedFault> faults{{.fault = Fault::kPositionDrift, .from = at_s(60), .amount = 3.0, .direction_deg = 90.0},
                                       {.fault = Fault::kDepthDrift, .from = at_s(60), .amount = -0.2},
                                       {.fault = Fault::kSpeedError, .from = at_s(60), .amount = 0.5}};
  const Disturbance d = disturbance_at(faults, at_s(70), Duration::seconds(1));
  EXPECT_NEAR(d.position_error.east.value, 30.0, 1e-9);
  EXPECT_NEAR(d.position_error.north.value, 0.0, 1e-9);
  EXPECT_NEAR(d.depth_error.value, -2.0, 1e-12);
  EXPECT_EQ(d.speed_error, MetersPerSecond{0.5});
  EXPECT_FALSE(d.is_place_stuck || d.stuck_depth);
}

TEST(DisturbanceAt, HoldsWhatIsStuckAndLetsItShiver) {
  const std::vector<TimedFault> faults{{.fault = Fault::kPositionShiver, .from = at_s(60), .amount = 0.01},
                                       {.fault = Fault::kDepthStuck, .from = at_s(60), .amount = 0.0}};
  for (const int s : {70, 71}) {
    const Disturbance d = disturbance_at(faults, at_s(s), Duration::seconds(1));
    EXPECT_TRUE(d.is_place_stuck);
    EXPECT_EQ(d.position_error.north, Meters{s % 2 == 0 ? 0.01 : -0.01});
    EXPECT_EQ(d.stuck_depth, Meters{0.0});
  }
}

}  // namespace
}  // namespace earshot::hil
