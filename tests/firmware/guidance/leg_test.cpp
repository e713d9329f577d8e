#include "firmware/guidance/leg.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/place.hpp"

namespace earshot::guidance {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRounding = 1e-12;  // a few roundings of angles near 1, and of metres near 1000 divided by the look-ahead

TEST(Leg, MeasuresAlongAndAcrossItself) {
  const Leg leg(at(100, 200), at(400, 600));  // a 3-4-5 triangle, 500 m towards 53 degrees
  EXPECT_NEAR(leg.length().value, 500, kRounding);
  EXPECT_NEAR(leg.along_track(at(400, 600)).value, 500, 1e-9);  // metres near 500, a few roundings
  EXPECT_NEAR(leg.cross_track(at(400, 600)).value, 0, 1e-9);
  // 100 m to the right of the start: right of (3, 4) is (-4, 3).
  EXPECT_NEAR(leg.cross_track(at(100 - 80, 200 + 60)).value, 100, 1e-9);
  EXPECT_NEAR(leg.along_track(at(100 - 80, 200 + 60)).value, 0, 1e-9);
}

TEST(Leg, SteersAlongItselfWhenOnTrack) {
  EXPECT_NEAR(Leg(at(0, 0), at(1000, 0)).heading_to_steer(at(500, 0)).value, 0, kRounding);
  EXPECT_NEAR(Leg(at(0, 0), at(0, 1000)).heading_to_steer(at(0, 500)).value, kPi / 2, kRounding);
  EXPECT_NEAR(Leg(at(0, 0), at(-1000, 0)).heading_to_steer(at(-500, 0)).value, kPi, kRounding);
  EXPECT_NEAR(Leg(at(0, 0), at(-1000, -1000)).heading_to_steer(at(0, 0)).value, -3 * kPi / 4, kRounding);
}

TEST(Leg, SteersFortyFiveDegreesTowardsTheTrackWhenOneLookAheadBesideIt) {
  const Leg north(at(0, 0), at(1000, 0));
  EXPECT_NEAR(north.heading_to_steer(at(300, Leg::kLookahead.value)).value, -kPi / 4, kRounding);  // right of the track: turn left
  EXPECT_NEAR(north.heading_to_steer(at(300, -Leg::kLookahead.value)).value, kPi / 4, kRounding);
}

TEST(Leg, KeepsItsHeadingWithinOneTurnWhenTheCorrectionCrossesSouth) {
  const Leg south(at(0, 0), at(-1000, 0));
  EXPECT_NEAR(south.heading_to_steer(at(-300, -Leg::kLookahead.value)).value, 3 * kPi / 4,
              kRounding);  // west is right of a southward track
  EXPECT_NEAR(south.heading_to_steer(at(-300, Leg::kLookahead.value)).value, -3 * kPi / 4, kRounding);
}

TEST(Leg, IsOverWhenTheVehicleCrossesTheLineThroughItsEndHoweverFarBeside) {
  const Leg leg(at(0, 0), at(1000, 0));
  EXPECT_FALSE(leg.is_over(at(999.9, 0)));
  EXPECT_TRUE(leg.is_over(at(1000, 0)));
  EXPECT_TRUE(leg.is_over(at(1000.1, 800)));
  EXPECT_FALSE(leg.is_over(at(-2000, 0)));
}

TEST(Leg, BringsAVehicleOffTheTrackBackToIt) {
  const Leg leg(at(0, 0), at(600, 800));
  NorthEast position = at(-80, 60);  // 100 m to the right of a leg towards (3, 4)
  while (!leg.is_over(position)) {
    const double heading = leg.heading_to_steer(position).value;
    position = position + at(2.0 * std::cos(heading), 2.0 * std::sin(heading));
  }
  EXPECT_LT(std::fabs(leg.cross_track(position).value), 0.1);  // e falls as exp(-x/D): 100 exp(-9) = 0.01 m, with room for the first bend
}

TEST(Leg, OfHalfAMetreHasADirectionToo) {
  const Leg east(at(0, 0), at(0, 0.5));
  EXPECT_NEAR(east.heading_to_steer(at(0, 0)).value, kPi / 2, kRounding);
  EXPECT_FALSE(east.is_over(at(0, 0.4)));
}

TEST(Leg, OfNoLengthIsOverAtOnce) {
  EXPECT_TRUE(Leg(at(5, 5), at(5, 5)).is_over(at(5, 5)));
  EXPECT_EQ(Leg(at(5, 5), at(5, 5)).heading_to_steer(at(5, 5)).value, 0.0);
}

}  // namespace
}  // namespace earshot::guidance
