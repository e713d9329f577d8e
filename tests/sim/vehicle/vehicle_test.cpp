#include "sim/vehicle/vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace earshot::vehicle {
namespace {

constexpr double kPi = std::numbers::pi;

State cruising(Radians heading) {
  return {.position = {}, .depth = Meters{300}, .heading = heading, .speed = MetersPerSecond{2}};
}

Command onward(Radians heading) {
  return {.heading = heading, .speed = MetersPerSecond{2}, .depth = Meters{300}};
}

TEST(Vehicle, CoversTwoHundredMetresEastInAHundredSecondsAtTwoMetresPerSecond) {
  const Radians east{kPi / 2};
  const State end = advance_for(cruising(east), onward(east), {}, Duration::seconds(100));
  // 1000 steps that each round to about 1e-14 m.
  EXPECT_NEAR(end.position.north.value, 0.0, 1e-10);
  EXPECT_NEAR(end.position.east.value, 200.0, 1e-10);
  EXPECT_EQ(end.depth.value, 300.0);
}

TEST(Vehicle, TurnsOnACircleOfSpeedOverTurnRate) {
  // A command always ahead on the right keeps it turning: after half a circle it stands one diameter (2 v / rate) to the east.
  const Limits limits{.turn_rate = RadiansPerSecond{0.1}, .speed_lag = Duration::seconds(5), .depth_rate = MetersPerSecond{0.5}};
  State state = cruising(Radians{0});
  const Duration half_circle{static_cast<std::int64_t>(kPi / 0.1 * 1e6)};
  const Duration step = Duration::milliseconds(10);
  for (Duration t{}; t < half_circle; t = t + step) state = advance(state, onward(state.heading + Radians{1.0}), limits, step);
  // The midpoint rule on a 0.001 rad turn errs by 4e-8 of the diameter; the last step overshoots by at most 0.02 m along the track (south).
  EXPECT_NEAR(state.position.east.value, 2 * 2.0 / 0.1, 1e-3);
  EXPECT_NEAR(state.position.north.value, 0.0, 0.02);
}

TEST(Vehicle, TurnsTheShorterWayAcrossSouth) {
  const State end = advance_for(cruising(Radians{0.9 * kPi}), onward(Radians{-0.9 * kPi}), {}, Duration::seconds(1));
  // 6 degrees to the right of 162 degrees, not to the left.
  EXPECT_NEAR(end.heading.value, 168.0 / 180.0 * kPi, 1e-9);
}

TEST(Vehicle, StopsTurningOnTheCommandedHeading) {
  const State end = advance_for(cruising(Radians{0}), onward(Radians{1.0}), {}, Duration::seconds(60));
  EXPECT_NEAR(end.heading.value, 1.0, 1e-15);  // one rounding of the last difference
}

TEST(Vehicle, ReachesSixtyThreePercentOfASpeedStepInOneTimeConstant) {
  State start = cruising(Radians{0});
  start.speed = MetersPerSecond{0};
  const State end = advance_for(start, onward(Radians{0}), {}, Duration::seconds(5));
  // 1 - 1/e = 0.6321; explicit steps of 1/50 of the time constant give 1 - (1 - 1/50)^50 = 0.6358.
  EXPECT_NEAR(end.speed.value / 2.0, 1.0 - 1.0 / std::numbers::e, 0.004);
}

TEST(Vehicle, DivesAtItsDepthRateAndThenKeepsItsDepth) {
  State start = cruising(Radians{0});
  start.depth = Meters{0};
  EXPECT_NEAR(advance_for(start, onward(Radians{0}), {}, Duration::seconds(100)).depth.value, 50.0, 1e-9);
  EXPECT_EQ(advance_for(start, onward(Radians{0}), {}, Duration::seconds(700)).depth.value, 300.0);
}

TEST(Vehicle, CoversTheMeanOfTheSpeedsBetweenWhichItGathersWay) {
  State start = cruising(Radians{0});
  start.speed = MetersPerSecond{0};
  // Of 5 s of lag, in steps of 0.1 s: the speed still missing is 2 % less after each, its mean in a step 1 % less than at its beginning:
  // 2 m/s x 0.1 s x 0.99 / 0.02 = 9.9 m less than the 200 m of a vehicle that had its speed from the beginning.
  EXPECT_NEAR(advance_for(start, onward(Radians{0}), {}, Duration::seconds(100)).position.north.value, 190.1, 1e-6);
}

TEST(Vehicle, TurnsToPortAndComesUpNoFasterThanToStarboardAndDown) {
  Command command = onward(Radians{-kPi / 2});
  command.depth = Meters{0};
  const State end = advance_for(cruising(Radians{0}), command, {}, Duration::seconds(10));
  EXPECT_NEAR(end.heading.value, -kPi / 3, 1e-9);  // 6 degrees a second
  EXPECT_NEAR(end.depth.value, 295.0, 1e-9);       // half a metre a second
}

}  // namespace
}  // namespace earshot::vehicle
