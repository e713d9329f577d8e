#include "firmware/safety/limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/core/random.hpp"
#include "tests/firmware/not_finite.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::safety {
namespace {

using tests::kInfinity;
using tests::kNan;

config::Mission mission() {
  return {.operating_area = {.south_west = at(0, 0), .north_east = at(10000, 20000)},
          .edge_margin = Meters{500},
          .search_depth = Meters{300},
          .max_depth = Meters{350},
          .search_speed = MetersPerSecond{2},
          .step_length = Meters{1000},
          .max_steps = 100,
          .max_time = Duration::seconds(60000),
          .navigation_timeout = Duration::seconds(5),
          .snr_timeout = Duration::seconds(60),
          .detection_threshold = Decibels{10},
          .action_seed = 1};
}

const messages::Navigation kFix{
    .time = {}, .position = at(5000, 5000), .depth = Meters{250}, .heading = Radians{1.0}, .speed = MetersPerSecond{2}};
const messages::Setpoint kWanted{.heading = Radians{0.5}, .speed = MetersPerSecond{2}, .depth = Meters{300}, .waypoint = at(6000, 5000)};

TEST(SafeWaypoint, LeavesAWaypointInsideTheMarginsAlone) {
  const SafeWaypoint safe = safe_waypoint(mission(), at(8600, 5000), at(9500, 5000));
  EXPECT_EQ(safe.waypoint, at(9500, 5000));
  EXPECT_FALSE(safe.overridden);
}

TEST(SafeWaypoint, PullsAWaypointBackToTheMargin) {
  const SafeWaypoint safe = safe_waypoint(mission(), at(8800, 19000), at(9507, 19707));
  EXPECT_EQ(safe.waypoint, at(9500, 19500));
  EXPECT_TRUE(safe.overridden);
}

TEST(SafeWaypoint, TurnsTowardsTheMiddleWhereTheEdgeLeavesLessThanHalfAStep) {
  // 300 m short of the northern margin, 5 km east of the middle: the middle lies (-4200, -5000) away, 6530 m.
  const SafeWaypoint safe = safe_waypoint(mission(), at(9200, 15000), at(10200, 15000));
  EXPECT_TRUE(safe.overridden);
  EXPECT_NEAR(safe.waypoint.north.value, 9200 - 1000 * 4200 / std::sqrt(4200.0 * 4200 + 5000.0 * 5000), 1e-9);  // metres, a few roundings
  EXPECT_NEAR(safe.waypoint.east.value, 15000 - 1000 * 5000 / std::sqrt(4200.0 * 4200 + 5000.0 * 5000), 1e-9);
}

TEST(SafeWaypoint, PullsAWaypointBackToTheMarginInTheSouthWestToo) {
  const SafeWaypoint safe = safe_waypoint(mission(), at(1200, 1200), at(493, 493));
  EXPECT_EQ(safe.waypoint, at(500, 500));
  EXPECT_TRUE(safe.overridden);
}

TEST(SafeWaypoint, GoesOnAlongTheWayWhereExactlyHalfAStepIsLeftAndTurnsBackWhereItIsLess) {
  EXPECT_EQ(safe_waypoint(mission(), at(9000, 10'000), at(10'000, 10'000)).waypoint, at(9500, 10'000));
  EXPECT_EQ(safe_waypoint(mission(), at(9000.5, 10'000), at(10'000.5, 10'000)).waypoint, at(8000.5, 10'000)) << "a step to the middle";
}

TEST(SafeWaypoint, FindsTheMiddleOfAnAreaWhoseCornerIsNotTheOrigin) {
  config::Mission elsewhere = mission();
  elsewhere.operating_area = {.south_west = at(-4000, 20'000), .north_east = at(6000, 40'000)};  // its middle is (1000, 30 000)
  EXPECT_EQ(safe_waypoint(elsewhere, at(1000, 25'000), at(kNan, 0)).waypoint, at(1000, 26'000));
  EXPECT_EQ(safe_waypoint(elsewhere, at(-2000, 30'000), at(kNan, 0)).waypoint, at(-1000, 30'000));
}

TEST(SafeWaypoint, GoesToTheMiddleItselfWhereThatIsNoFurtherThanAStep) {
  EXPECT_EQ(safe_waypoint(mission(), at(5000, 9400), at(kNan, 0)).waypoint, at(5000, 10'000));
  EXPECT_EQ(safe_waypoint(mission(), at(5000, 9000), at(kNan, 0)).waypoint, at(5000, 10'000));
}

TEST(SafeWaypoint, TurnsTowardsTheMiddleWhenThePolicySpeaksNonsense) {
  const SafeWaypoint safe = safe_waypoint(mission(), at(5000, 9000), at(kNan, kInfinity));
  EXPECT_EQ(safe.waypoint, at(5000, 10000));
  EXPECT_TRUE(safe.overridden);
}

TEST(SafeWaypoint, TurnsTowardsTheMiddleWhereOneComponentAloneIsNotFinite) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (const NorthEast wanted : {at(bad, 9000), at(6000, bad)}) {
      const SafeWaypoint safe = safe_waypoint(mission(), at(5000, 8000), wanted);
      EXPECT_EQ(safe.waypoint, at(5000, 9000));  // one step of 1 km towards the middle, 2 km east
      EXPECT_TRUE(safe.overridden);
    }
  }
}

TEST(SafeWaypoint, NeverLeavesTheMarginsNorGivesLessThanHalfAStepInTheSmallestAreaAllowed) {
  config::Mission smallest = mission();
  smallest.operating_area.north_east = at(3000, 3000);
  ASSERT_EQ(config::check(smallest), Status::kOk);
  const Rectangle allowed{.south_west = at(500, 500), .north_east = at(2500, 2500)};
  Pcg32 random(1);
  for (int i = 0; i < 100000; ++i) {
    const NorthEast position = at(500 + 2000 * random.uniform_double(), 500 + 2000 * random.uniform_double());
    const double bearing = 6.283 * random.uniform_double();
    const NorthEast wanted = position + at(1000 * std::cos(bearing), 1000 * std::sin(bearing));
    const NorthEast given = safe_waypoint(smallest, position, wanted).waypoint;
    ASSERT_TRUE(allowed.contains(given));
    const NorthEast leg = given - position;
    ASSERT_GE(std::hypot(leg.north.value, leg.east.value), 500.0 - 1e-9);  // rounding of metres near 3000
  }
}

// 25 km long and 2.5 km wide, 100 m from its long edge: the middle lies (11500, -1150) away, so that a step towards it makes 995 m along
// the area and 99.5 m across; the margin is 150 m across.
TEST(SafeWaypoint, KeepsTheMarginWhereAStepToTheMiddleOfALongAreaDoesNot) {
  config::Mission mission_of_long_area = mission();
  mission_of_long_area.operating_area.north_east = at(25'000, 2500);
  mission_of_long_area.edge_margin = Meters{250};
  ASSERT_EQ(config::check(mission_of_long_area), Status::kOk);
  const double along = 1000 * 11'500 / std::sqrt(11'500.0 * 11'500 + 1150.0 * 1150);
  for (const double wanted_north : {1000.0, kNan}) {
    const SafeWaypoint safe = safe_waypoint(mission_of_long_area, at(1000, 2400), at(wanted_north, 3400));
    EXPECT_NEAR(safe.waypoint.north.value, 1000 + along, 1e-9);  // metres, a few roundings
    EXPECT_EQ(safe.waypoint.east.value, 2250.0);
    EXPECT_TRUE(safe.overridden);
  }
}

TEST(SafeWaypoint, NeverLeavesTheMarginsNorGivesLessThanHalfAStepFromAnywhereInALongArea) {
  config::Mission mission_of_long_area = mission();
  mission_of_long_area.operating_area.north_east = at(25'000, 2500);
  mission_of_long_area.edge_margin = Meters{250};
  const Rectangle allowed{.south_west = at(250, 250), .north_east = at(24'750, 2250)};
  Pcg32 random(2);
  for (int i = 0; i < 100'000; ++i) {
    const NorthEast position = at(25'000 * random.uniform_double(), 2500 * random.uniform_double());
    const double bearing = 6.283 * random.uniform_double();
    const NorthEast given =
        safe_waypoint(mission_of_long_area, position, position + at(1000 * std::cos(bearing), 1000 * std::sin(bearing))).waypoint;
    ASSERT_TRUE(allowed.contains(given)) << position.north.value << " " << position.east.value;
    const NorthEast leg = given - position;
    ASSERT_GE(std::hypot(leg.north.value, leg.east.value), 500.0 - 1e-9);  // rounding of metres near 25 000
  }
}

TEST(SafeSetpoint, LeavesASetpointWithinItsLimitsAlone) {
  const SafeSetpoint safe = safe_setpoint(mission(), kFix, kWanted, {});
  EXPECT_EQ(safe.setpoint, kWanted);
  EXPECT_FALSE(safe.limited);
}

TEST(SafeSetpoint, KeepsDepthAndSpeedWithinTheirLimits) {
  messages::Setpoint wanted = kWanted;
  wanted.depth = Meters{351};
  wanted.speed = MetersPerSecond{2.1};
  SafeSetpoint safe = safe_setpoint(mission(), kFix, wanted, {});
  EXPECT_TRUE(safe.limited);
  EXPECT_EQ(safe.setpoint.depth, Meters{350});
  EXPECT_EQ(safe.setpoint.speed, MetersPerSecond{2});
  wanted.depth = Meters{-1};
  wanted.speed = MetersPerSecond{-0.1};
  safe = safe_setpoint(mission(), kFix, wanted, {});
  EXPECT_TRUE(safe.limited);
  EXPECT_EQ(safe.setpoint.depth, Meters{0});
  EXPECT_EQ(safe.setpoint.speed, MetersPerSecond{0});
}

TEST(SafeSetpoint, BringsTheVehicleUpWhenAnythingIsNotFinite) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (int field = 0; field < 5; ++field) {
      messages::Setpoint wanted = kWanted;
      if (field == 0) wanted.heading = Radians{bad};
      if (field == 1) wanted.speed = MetersPerSecond{bad};
      if (field == 2) wanted.depth = Meters{bad};
      if (field == 3) wanted.waypoint.north = Meters{bad};
      if (field == 4) wanted.waypoint.east = Meters{bad};
      const SafeSetpoint safe = safe_setpoint(mission(), kFix, wanted, {});
      EXPECT_TRUE(safe.limited) << field;
      EXPECT_EQ(safe.setpoint, come_up(mission(), kFix, {}, false)) << field;
    }
  }
}

messages::Navigation fix_of(double heading, double depth) {
  return {.time = {}, .position = at(1, 2), .depth = Meters{depth}, .heading = Radians{heading}, .speed = MetersPerSecond{2}};
}

constexpr double kPi = 3.141592653589793;

TEST(ComeUp, KeepsAHeadingBeyondHalfATurnAsTheSameDirectionWithin) {
  const auto heading_of = [](double heading) { return come_up(mission(), fix_of(heading, 300), {}, false).heading.value; };
  EXPECT_NEAR(heading_of(4.0), 4.0 - 2.0 * kPi, 1e-15);   // doubles near 4
  EXPECT_NEAR(heading_of(-4.0), 2.0 * kPi - 4.0, 1e-15);  // as above
}

TEST(ComeUp, StopsWhereTheVehicleIsWhenItFloatsUpByItself) {
  const messages::Setpoint setpoint = come_up(mission(), fix_of(1.5, 300), {}, false);
  EXPECT_EQ(setpoint.speed, MetersPerSecond{0});
  EXPECT_EQ(setpoint.depth, Meters{0});
  EXPECT_EQ(setpoint.heading, Radians{1.5});
  EXPECT_EQ(setpoint.waypoint, at(1, 2));
  EXPECT_FALSE(setpoint.release_weight);
}

config::Mission mission_of_a_torpedo() {
  config::Mission torpedo = mission();
  torpedo.max_depth = Meters{400};
  torpedo.safety.vehicle.ascent_speed = MetersPerSecond{0.7};
  torpedo.safety.vehicle.turn_radius = Meters{35};
  return torpedo;
}

// Whatever its depth says.
TEST(ComeUp, KeepsAHullThatNeedsSpeedGoingRoundUntilItIsUp) {
  const messages::Setpoint deep = come_up(mission_of_a_torpedo(), fix_of(3.0, 0.0), {}, false);
  EXPECT_EQ(deep.speed, MetersPerSecond{0.7});
  EXPECT_EQ(deep.depth, Meters{0});
  EXPECT_NEAR(deep.heading.value, 3.0 - 1.5 * kPi, 1e-15) << "a quarter of a turn to the right, over south";
  const messages::Setpoint up = come_up(mission_of_a_torpedo(), fix_of(3.0, 300.0), {}, true);
  EXPECT_EQ(up.speed, MetersPerSecond{0});
  EXPECT_EQ(up.heading, Radians{3.0});
}

TEST(ComeUp, GoesOnTurningWhenNobodySaysWhereTheVehiclePoints) {
  const auto heading_after = [](std::int64_t s) {
    return come_up(mission_of_a_torpedo(), fix_of(0.5, 300), Duration::seconds(s), false).heading.value;
  };
  EXPECT_NEAR(heading_after(10), 0.5 + kPi / 2 + 0.1, 1e-12) << "7 m round a circle of 70 m";
  EXPECT_NEAR(heading_after(300), 0.5 + kPi / 2 + 3.0 - 2 * kPi, 1e-12);
}

TEST(BlindRadius, IsTwiceTheVehiclesAndNoneIsTighterThanTwentyMetres) {
  EXPECT_EQ(blind_radius(Meters{0}), Meters{20});
  EXPECT_EQ(blind_radius(Meters{10}), Meters{20});
  EXPECT_EQ(blind_radius(Meters{30}), Meters{60});
}

}  // namespace
}  // namespace earshot::safety
