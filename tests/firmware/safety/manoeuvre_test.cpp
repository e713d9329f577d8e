#include "firmware/safety/manoeuvre.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/firmware/safety/rule_rig.hpp"

namespace earshot::safety {
namespace {

using config::Response;

constexpr double kNorth = 0.0;
constexpr double kEast = std::numbers::pi / 2;
constexpr double kSouth = std::numbers::pi;
constexpr double kWest = -std::numbers::pi / 2;

class ManoeuvreTest : public testing::Test {
 protected:
  messages::Setpoint of(Response response, NorthEast place, double heading, double depth_m = 300.0) {
    Situation situation = well(mission_, place, heading, depth_m);
    situation.is_steered_back = response == Response::kSteerBack || is_steered_back_;
    return manoeuvre_.setpoint(mission_, situation, response);
  }

  config::Mission mission_ = fenced_mission();
  Manoeuvre manoeuvre_;
  bool is_steered_back_ = false;
};

TEST_F(ManoeuvreTest, SteersBackToTheNearestPlaceInsideByTheShorterWayRound) {
  const messages::Setpoint setpoint = of(Response::kSteerBack, at(5000, 10'200), kNorth + 0.1);
  EXPECT_NEAR(setpoint.heading.value, 0.1 - std::numbers::pi / 2, 1e-12)
      << "a quarter of a turn at a time: to the left, where west is nearer";
  EXPECT_EQ(setpoint.waypoint, at(5000, 10'000));
  EXPECT_EQ(setpoint.speed, MetersPerSecond{2});
  EXPECT_EQ(setpoint.depth, Meters{300});
  EXPECT_NEAR(of(Response::kSteerBack, at(5000, 10'200), kNorth - 0.1).heading.value, kWest, 1e-12) << "less than that is left";
  EXPECT_NEAR(of(Response::kSteerBack, at(5000, 10'200), kNorth + 0.009).heading.value, kWest + 0.009, 1e-12) << "a little more";
}

TEST_F(ManoeuvreTest, KeepsTheSideOfItsTurnWhateverBecomesNearerMeanwhile) {
  // Eastwards and a little to the north: to the left, over north.
  EXPECT_NEAR(of(Response::kSteerBack, at(5000, 10'200), kEast - 0.1).heading.value, -0.1, 1e-12);
  // Pushed round to a little south of east, where a turn to the right were shorter: still to the left.
  EXPECT_NEAR(of(Response::kSteerBack, at(5000, 10'210), kEast + 0.1).heading.value, 0.1, 1e-12);
  manoeuvre_.end();
  EXPECT_NEAR(of(Response::kSteerBack, at(5000, 10'210), kEast + 0.1).heading.value, 0.1 - std::numbers::pi, 1e-12)
      << "anew: to the right, over south";
}

TEST_F(ManoeuvreTest, KeepsTheSideOfItsTurnWhileItHoldsToo) {
  is_steered_back_ = true;
  EXPECT_NEAR(of(Response::kHold, at(5000, 10'200), kEast - 0.1).heading.value, -0.1, 1e-12);
  EXPECT_NEAR(of(Response::kHold, at(5000, 10'210), kEast + 0.1).heading.value, 0.1, 1e-12) << "still to the left";
}

// Northwards over the northern edge and 1 m from the eastern one: its circle to the right, 200 m across, ends 99 m beyond the save polygon.
// 60 m north of the fence it turned to the left, over west, and a little further than south: back to the right it is 0.2 rad, on to the
// left six.
TEST_F(ManoeuvreTest, KeepsNoSideOnceItHasTurnedRound) {
  EXPECT_NEAR(of(Response::kSteerBack, at(10'060, 5000), kNorth - 0.5).heading.value, kWest - 0.5, 1e-12) << "to the left";
  EXPECT_NEAR(of(Response::kSteerBack, at(10'060, 5000), kWest).heading.value, kSouth, 1e-12);
  EXPECT_NEAR(of(Response::kSteerBack, at(10'060, 5000), kSouth - 0.2).heading.value, kSouth, 1e-12);
  // A right angle beyond that it is a turn of its own: by the shorter way, to the right over east and south.
  EXPECT_NEAR(of(Response::kSteerBack, at(10'060, 5000), kEast - 0.1).heading.value, kSouth - 0.1, 1e-12);
}

// Two edges run from a tip at the origin to the north-east and north-west. 28 m south-east of the eastern one the way back is north-west,
// though the nearest place inside is the inner tip, far to the north.
TEST_F(ManoeuvreTest, GoesStraightBackOverTheEdgeOfAnAcuteCorner) {
  mission_.safety.fence->inside = polygon({at(200, 0), at(900, 700), at(900, -700)});
  mission_.safety.fence->save = polygon({at(0, 0), at(1000, 1000), at(1000, -1000)});
  const messages::Setpoint beyond_save = of(Response::kSteerBack, at(20, 60), kNorth);
  EXPECT_NEAR(beyond_save.heading.value, -std::numbers::pi / 4, 1e-12);
  EXPECT_EQ(beyond_save.waypoint, at(200, 0));
  EXPECT_NEAR(of(Response::kSteerBack, at(70, 60), kNorth).heading.value, std::atan2(-60, 130), 1e-12) << "it has crossed the edge";
  EXPECT_NEAR(of(Response::kSteerBack, at(60, 60.7), kNorth).heading.value, std::atan2(-60.7, 140), 1e-12) << "half a metre beyond";
}

TEST_F(ManoeuvreTest, ChoosesItsSideAnewWhenItWasInsideMeanwhile) {
  for (const Response response : {Response::kHold, Response::kReturn}) {
    is_steered_back_ = true;
    EXPECT_NEAR(of(response, at(5000, 10'200), kEast - 0.1).heading.value, -0.1, 1e-12) << "to the left, over north";
    is_steered_back_ = false;
    (void)of(response, at(5000, 9000), kNorth);
    is_steered_back_ = true;
    EXPECT_NEAR(of(response, at(5000, 10'200), kEast + 0.1).heading.value, kSouth + 0.1 - 2 * kSouth, 1e-12) << "to the right, over south";
    is_steered_back_ = false;
    (void)of(response, at(5000, 9000), kNorth);
  }
}

TEST_F(ManoeuvreTest, TurnsInACornerToWhereThereIsRoom) {
  mission_.safety.vehicle.turn_radius = Meters{100};
  EXPECT_NEAR(of(Response::kSteerBack, at(10'090, 9'999), kNorth).heading.value, kWest, 1e-12);
  manoeuvre_.end();
  EXPECT_NEAR(of(Response::kSteerBack, at(10'090, 1), kNorth).heading.value, kEast, 1e-12);
  manoeuvre_.end();
  EXPECT_NEAR(of(Response::kSteerBack, at(10'090, 9'999), kEast).heading.value, kSouth, 1e-12) << "a right angle is no way round";
}

TEST_F(ManoeuvreTest, TurnsRoundBeforeTheFenceAwayFromWhereItWouldLeave) {
  const messages::Setpoint setpoint = of(Response::kSteerBack, at(9990, 5000), kNorth);
  // Its way round ends at 10 023.9 m: 23.9 m south of there it is inside.
  EXPECT_EQ(setpoint.waypoint, at(10'000, 5000));
  EXPECT_NEAR(std::abs(setpoint.heading.value), std::numbers::pi / 2, 1e-12) << "to south, by way of one side";
}

TEST_F(ManoeuvreTest, HoldsWhereItBeganTo) {
  const messages::Setpoint first = of(Response::kHold, at(4000, 4000), kEast);
  EXPECT_EQ(first.waypoint, at(4000, 4000));
  EXPECT_EQ(first.speed, MetersPerSecond{0}) << "this vehicle hovers";
  EXPECT_EQ(first.heading, Radians{kEast});
  const messages::Setpoint drifted = of(Response::kHold, at(4000, 4100), kEast);
  EXPECT_EQ(drifted.waypoint, at(4000, 4000));
  EXPECT_EQ(drifted.speed, MetersPerSecond{2});
  EXPECT_NEAR(drifted.heading.value, kWest, 1e-12);
}

TEST_F(ManoeuvreTest, HoldsByGoingRoundWhenItCannotHover) {
  mission_.safety.vehicle.hold_speed = MetersPerSecond{1};
  const messages::Setpoint setpoint = of(Response::kHold, at(4000, 4000), kNorth);
  EXPECT_EQ(setpoint.speed, MetersPerSecond{1});
  EXPECT_NEAR(setpoint.heading.value, kEast, 1e-12);
}

TEST_F(ManoeuvreTest, ReturnsToTheSafePointAndHoldsThere) {
  const messages::Setpoint far = of(Response::kReturn, at(5000, 1000), kNorth);
  EXPECT_NEAR(far.heading.value, kEast, 1e-12);
  EXPECT_EQ(far.speed, MetersPerSecond{2});
  EXPECT_EQ(far.waypoint, at(5000, 5000));
  EXPECT_EQ(of(Response::kReturn, at(5000, 4960), kNorth).speed, MetersPerSecond{0}) << "two turn radii are near";
  EXPECT_EQ(of(Response::kReturn, at(5000, 4959), kNorth).speed, MetersPerSecond{2});
}

TEST_F(ManoeuvreTest, MindsTheFenceWhileItHoldsOrReturns) {
  is_steered_back_ = true;
  for (const Response response : {Response::kHold, Response::kReturn})
    EXPECT_EQ(of(response, at(5000, 10'200), kWest).waypoint, at(5000, 10'000));
}

TEST_F(ManoeuvreTest, LeavesAZoneBeforeItComesUp) {
  ASSERT_EQ(mission_.safety.no_surface.push_back(square(2000, 3000)), Status::kOk);
  const messages::Setpoint under = of(Response::kSurface, at(2900, 2500), kSouth);
  EXPECT_EQ(under.depth, Meters{300});
  EXPECT_EQ(under.speed, MetersPerSecond{2});
  EXPECT_EQ(under.waypoint, at(3000, 2500));
  EXPECT_NEAR(under.heading.value, kNorth, 1e-12);
  EXPECT_EQ(of(Response::kSurface, at(3000.1, 2500), kNorth).depth, Meters{0});
  EXPECT_EQ(of(Response::kAbort, at(2900, 2500), kSouth).depth, Meters{0}) << "an abort asks nobody";
}

// Two fixes 4 s apart say one place; the newer is 3 s old.
TEST(SituationUnseen, CountsFromWhenTheVehicleWasSeenToMove) {
  Situation situation = well(fenced_mission());
  messages::Navigation same = *situation.navigation.newest();
  same.time = same.time + Duration::seconds(4);
  ASSERT_TRUE(situation.navigation.take(same.time, same, true));
  situation.now = same.time + Duration::seconds(3);
  EXPECT_EQ(situation.unseen(), Duration::seconds(7));
}

// It was told to search at 300 m for a minute, and has said 0 m all the time.
TEST_F(ManoeuvreTest, StopsNobodyForADepthThatSaysAlone) {
  mission_.safety.vehicle.ascent_speed = MetersPerSecond{0.7};
  const config::VehicleLimits& vehicle = mission_.safety.vehicle;
  for (const Response response : {Response::kSurface, Response::kAbort, Response::kRelease}) {
    Situation situation = well(mission_, at(5000, 5000), kNorth, 0.0);
    EXPECT_EQ(manoeuvre_.setpoint(mission_, situation, response).speed, MetersPerSecond{0.0}) << "it never was anywhere else";
    for (int s = 0; s <= 60; ++s)
      situation.depth.note_order(situation.now + Duration::seconds(s),
                                 {.heading = {}, .speed = MetersPerSecond{2}, .depth = Meters{300}, .waypoint = {}}, vehicle);
    EXPECT_EQ(manoeuvre_.setpoint(mission_, situation, response).speed, MetersPerSecond{0.7});
  }
}

TEST_F(ManoeuvreTest, AsksForTheWeightOnlyWhereARuleSaysSo) {
  EXPECT_FALSE(of(Response::kAbort, at(5000, 5000), kNorth).release_weight);
  EXPECT_TRUE(of(Response::kRelease, at(5000, 5000), kNorth).release_weight);
  EXPECT_EQ(of(Response::kRelease, at(5000, 5000), kNorth).depth, Meters{0});
}

}  // namespace
}  // namespace earshot::safety
