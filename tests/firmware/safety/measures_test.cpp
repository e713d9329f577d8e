#include "firmware/safety/measures.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "firmware/safety/limits.hpp"
#include "tests/firmware/safety/rule_rig.hpp"

namespace earshot::safety {
namespace {

using config::Condition;

class Measures : public testing::Test {
 protected:
  [[nodiscard]] std::optional<double> of(Condition condition) const { return measure(condition, mission_, situation_); }
  void put(const messages::Navigation& fix) {
    situation_.now = fix.time;
    ASSERT_TRUE(situation_.navigation.take(fix.time, fix, true));
    situation_.track.take(fix);
  }
  [[nodiscard]] Time after(std::int64_t seconds) const { return situation_.now + Duration::seconds(seconds); }

  config::Mission mission_ = fenced_mission();
  Situation situation_ = well(mission_);
};

TEST_F(Measures, OfAgesAreSecondsSinceADateAndNeverLessThanNone) {
  const Time began = situation_.now;
  situation_.vehicle = messages::VehicleStatus{.time = began, .altitude = Meters{100}};
  situation_.autopilot = messages::AutopilotStatus{.time = began + Duration::seconds(100)};
  situation_.now = began + Duration::milliseconds(2500);
  EXPECT_EQ(of(Condition::kNavigationAge), 2.5);
  EXPECT_EQ(of(Condition::kSnrAge), 2.5);
  EXPECT_EQ(of(Condition::kVehicleStatusAge), 2.5);
  EXPECT_EQ(of(Condition::kAutopilotAge), 0.0) << "ahead";
  EXPECT_EQ(of(Condition::kSearchTime), 12.5);
  EXPECT_EQ(of(Condition::kOperatorAge), 12.5) << "nobody was heard since the search began";
  situation_.operator_heard = began;
  EXPECT_EQ(of(Condition::kOperatorAge), 2.5);
  situation_.vehicle.reset();
  EXPECT_EQ(of(Condition::kVehicleStatusAge), 12.5) << "it was never heard";
}

TEST_F(Measures, OfTheHaltPolygonIsHowFarBeyondItTheVehicleIs) {
  EXPECT_EQ(of(Condition::kOutsideHalt), 0.0);
  situation_ = well(mission_, at(5000, 10'340));
  EXPECT_EQ(of(Condition::kOutsideHalt), 40.0);
  mission_.safety.fence.reset();
  EXPECT_EQ(of(Condition::kOutsideHalt), 340.0) << "without a fence, of the operating area";
  EXPECT_EQ(of(Condition::kOutsideFence), 0.0);
}

// Northwards its way round ends 33.854 m ahead.
TEST_F(Measures, OfTheFenceLooksAheadAsFarAsTheVehicleNeedsToTurn) {
  situation_ = well(mission_, at(10'060, 5000));
  EXPECT_EQ(of(Condition::kOutsideFence), 0.0) << "the save polygon ends at 10 100 m";
  situation_ = well(mission_, at(10'070, 5000));
  EXPECT_NEAR(*of(Condition::kOutsideFence), 3.853981633974483, 1e-9);
  situation_ = well(mission_, at(10'070, 5000), std::numbers::pi);
  EXPECT_EQ(of(Condition::kOutsideFence), 0.0) << "on its way in";
  situation_.is_steered_back = true;
  EXPECT_EQ(of(Condition::kOutsideFence), 70.0) << "it is not free before it is inside";
}

TEST_F(Measures, OfDepthAndAltitudeAreWhatTheyWillBeInFiveSeconds) {
  situation_.vehicle = messages::VehicleStatus{.time = situation_.now, .altitude = Meters{80}};
  EXPECT_EQ(of(Condition::kDepth), 300.0);
  EXPECT_EQ(of(Condition::kAltitude), 80.0);
  put(fix_at(after(2), at(5004, 5000), 0.0, 303.0));  // 1.5 m/s down
  EXPECT_EQ(of(Condition::kDepth), 310.5);
  EXPECT_EQ(of(Condition::kAltitude), 72.5);
  put(fix_at(after(4), at(5012, 5000), 0.0, 290.0));
  EXPECT_EQ(of(Condition::kDepth), 290.0) << "on its way up it is as deep as it is";
  EXPECT_EQ(of(Condition::kAltitude), 80.0);
  put(fix_at(after(2), at(5016, 5000), 0.0, 290.4));  // 0.2 m/s down
  EXPECT_EQ(of(Condition::kDepth), 290.4) << "so much, a vehicle that keeps its depth goes up and down";
  EXPECT_EQ(of(Condition::kAltitude), 80.0);
  put(fix_at(after(2), at(5020, 5000), 0.0, 290.9));  // 0.25 m/s down
  EXPECT_NEAR(*of(Condition::kDepth), 292.15, 1e-9);
  situation_.vehicle->altitude = Meters{std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(of(Condition::kAltitude), std::nullopt) << "no bottom in reach";
}

TEST_F(Measures, OfMovementAreInTheirUnits) {
  put(fix_at(after(2), at(5004, 5000), 0.2));
  EXPECT_EQ(of(Condition::kSpeed), 2.0);
  EXPECT_NEAR(*of(Condition::kTurnRate), 18.0 / std::numbers::pi, 1e-12) << "0.1 rad/s";
  for (int i = 0; i < 50; ++i) put(fix_at(after(2), at(5008 + 4 * i, 5000)));
  EXPECT_EQ(of(Condition::kDistanceTravelled), 156.0) << "three strides of 52 m";
  EXPECT_EQ(of(Condition::kNavigationFrozen), 0.0);
  put(fix_at(after(5), at(5204, 5000)));
  EXPECT_EQ(of(Condition::kNavigationFrozen), 5.0);
  EXPECT_FALSE(situation_.navigation.take(situation_.now, fix_at(situation_.now, at(9204, 5000)), true));
  EXPECT_EQ(of(Condition::kNavigationJump), 4000.0 - 25.0);
  situation_.track.set_waypoint(at(9000, 5000));
  situation_.now = after(7);
  EXPECT_EQ(of(Condition::kNoProgress), 7.0);
  messages::Navigation silent_log = fix_at(situation_.now, at(5204, 5000));
  silent_log.speed = messages::kUnknownSpeed;
  put(silent_log);
  EXPECT_EQ(of(Condition::kSpeed), std::nullopt);
}

TEST_F(Measures, OfTheBatteryKnowTheWayHome) {
  EXPECT_EQ(of(Condition::kBattery), std::nullopt) << "nobody said";
  EXPECT_EQ(of(Condition::kBatteryAtHome), std::nullopt);
  situation_ = well(mission_, at(5000, 2000));
  situation_.vehicle = messages::VehicleStatus{.time = situation_.now, .battery_percent = 40};
  EXPECT_EQ(of(Condition::kBattery), 40.0);
  EXPECT_EQ(of(Condition::kBatteryAtHome), 32.0) << "3 km against 0.5 m/s at 2 m/s are 4 km, at 2 % each";
  mission_.safety.safe_point.reset();
  EXPECT_EQ(of(Condition::kBatteryAtHome), std::nullopt);
}

TEST_F(Measures, OfWhatIsTrueOrFalseAreOneOrZeroAndNothingWhileNobodySays) {
  for (const Condition condition : {Condition::kLeak, Condition::kGroundFault, Condition::kHydrophoneDeaf, Condition::kAutopilotDisengaged})
    EXPECT_EQ(of(condition), std::nullopt);
  situation_.vehicle = messages::VehicleStatus{.time = situation_.now, .has_leak = true};
  situation_.hydrophone = messages::HydrophoneStatus{.time = situation_.now, .is_deaf = true};
  situation_.autopilot = messages::AutopilotStatus{.time = situation_.now, .follows_setpoints = true};
  EXPECT_EQ(of(Condition::kLeak), 1.0);
  EXPECT_EQ(of(Condition::kGroundFault), 0.0);
  EXPECT_EQ(of(Condition::kHydrophoneDeaf), 1.0);
  EXPECT_EQ(of(Condition::kAutopilotDisengaged), 0.0);
  situation_.vehicle = messages::VehicleStatus{.time = situation_.now, .has_ground_fault = true};
  situation_.autopilot->follows_setpoints = false;
  EXPECT_EQ(of(Condition::kLeak), 0.0);
  EXPECT_EQ(of(Condition::kGroundFault), 1.0);
  EXPECT_EQ(of(Condition::kAutopilotDisengaged), 1.0);
  EXPECT_EQ(of(Condition::kPolicyUnhealthy), 0.0);
  situation_.is_policy_unhealthy = true;
  EXPECT_EQ(of(Condition::kPolicyUnhealthy), 1.0);
}

TEST_F(Measures, OfSmallDifferencesAreNotNegative) {
  situation_ = well(mission_, at(5000, 5000), 0.5, 300.5);
  situation_.commanded =
      messages::Setpoint{.heading = Radians{0.0}, .speed = MetersPerSecond{2}, .depth = Meters{300}, .waypoint = at(6000, 5000)};
  EXPECT_EQ(of(Condition::kDepthIgnored), 0.5);
  EXPECT_NEAR(*of(Condition::kHeadingIgnored), 28.64788975654116, 1e-12) << "half a radian";
}

TEST_F(Measures, OfSetpointsThatAreIgnoredAreTheWayToThem) {
  EXPECT_EQ(of(Condition::kHeadingIgnored), std::nullopt) << "nothing was commanded yet";
  EXPECT_EQ(of(Condition::kDepthIgnored), std::nullopt);
  situation_ = well(mission_, at(5000, 5000), 3.0, 280.0);
  situation_.commanded =
      messages::Setpoint{.heading = Radians{-3.0}, .speed = MetersPerSecond{2}, .depth = Meters{300}, .waypoint = at(6000, 5000)};
  EXPECT_NEAR(*of(Condition::kHeadingIgnored), 16.225322921506063, 1e-12) << "2 pi - 6 rad, over south";
  EXPECT_EQ(of(Condition::kDepthIgnored), 20.0);
}

TEST_F(Measures, OfAVehicleThatGoesRoundItsSetpointIsIgnoredOnlyWhileItDoesNotTurn) {
  const auto command_round = [this] {
    const messages::Navigation& fix = *situation_.navigation.newest();
    situation_.commanded = messages::Setpoint{.heading = fix.heading + Radians{std::numbers::pi / 2},
                                              .speed = MetersPerSecond{1},
                                              .depth = Meters{300},
                                              .waypoint = fix.position};
    situation_.goes_round = goes_round(fix, *situation_.commanded);
    EXPECT_TRUE(situation_.goes_round);
  };
  situation_ = well(mission_, at(5000, 5000), 0.0, 300.0);
  for (int s = 1; s <= 6; ++s) {
    put({.time = after(1), .position = at(5000 + s, 5000), .depth = Meters{300}, .heading = Radians{0.0}, .speed = MetersPerSecond{1}});
    command_round();
  }
  EXPECT_NEAR(*of(Condition::kHeadingIgnored), 90.0, 1e-9);
  for (int s = 1; s <= 6; ++s) {
    put({.time = after(1), .position = at(5006 + s, 5000), .depth = Meters{300}, .heading = Radians{0.1 * s}, .speed = MetersPerSecond{1}});
    command_round();
  }
  EXPECT_EQ(of(Condition::kHeadingIgnored), 0.0);
  situation_.goes_round = false;
  EXPECT_NEAR(*of(Condition::kHeadingIgnored), 90.0, 1e-9) << "a set-point that stands still is ignored by a vehicle that turns past it";
}

}  // namespace
}  // namespace earshot::safety
