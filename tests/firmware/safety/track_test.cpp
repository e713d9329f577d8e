#include "firmware/safety/track.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/core/math.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::safety {
namespace {

messages::Navigation fix(std::int64_t second, NorthEast place, double depth_m = 0.0, double heading = 0.0) {
  return {.time = Time{} + Duration::seconds(second),
          .position = place,
          .depth = Meters{depth_m},
          .heading = Radians{heading},
          .speed = MetersPerSecond{2}};
}

TEST(Track, TakesRatesOverTwoSecondsOrMore) {
  Track track;
  track.begin(fix(10, at(0, 0), 100, 3.0));
  track.take(fix(11, at(100, 0), 100, 3.0));
  EXPECT_FALSE(track.velocity_per_s()) << "one second says little";
  track.take(fix(12, at(6, -8), 104, -3.0));
  EXPECT_EQ(track.velocity_per_s(), at(3, -4));
  EXPECT_EQ(track.sink_rate(), MetersPerSecond{2});
  // From 3 to -3 rad it is 0.2831853 rad, over south, in 2 s.
  EXPECT_NEAR(track.turn_rate().value, 0.1415926535897931, 1e-15);
  track.begin(fix(20, at(0, 0), 100, -3.0));
  track.take(fix(22, at(0, 0), 100, 3.0));
  EXPECT_NEAR(track.turn_rate().value, 0.1415926535897931, 1e-15) << "to the left";
}

// At 3 rad/s (172 degrees a second) seen every second: 3 rad to the right, 12 rad in four seconds, whichever fix is the newest.
TEST(Track, CountsRoundAndRoundWhateverTurnsAtMostAHalfCircleBetweenTwoFixes) {
  for (const double rate : {3.0, -3.0, 1.0, 0.25}) {
    Track track;
    track.begin(fix(0, at(0, 0)));
    for (int second = 1; second <= 60; ++second) {
      track.take(fix(second, at(0, 0), 0.0, wrap_to_pi(Radians{rate * second}).value));
      if (second < 2) continue;
      EXPECT_NEAR(track.turn_rate().value, std::abs(rate), 1e-12) << rate << " after " << second << " s";  // headings are rounded
    }
  }
}

TEST(Track, KeepsItsBaseShort) {
  Track track;
  track.begin(fix(0, at(0, 0)));
  for (int second = 1; second <= 100; ++second) track.take(fix(second, at(second <= 96 ? 0 : 5 * (second - 96), 0)));
  EXPECT_EQ(track.velocity_per_s(), at(5, 0)) << "of the last 2 to 4 s";
}

TEST(Track, CountsWayInStridesSoThatNoiseIsNone) {
  Track track;
  track.begin(fix(0, at(0, 0)));
  for (int second = 1; second <= 1000; ++second) track.take(fix(second, at(second % 2 == 0 ? 20 : -20, 0)));
  EXPECT_EQ(track.distance(), Meters{0});
  for (int second = 1; second <= 100; ++second) track.take(fix(1000 + second, at(0, 2 * second)));
  EXPECT_EQ(track.distance(), Meters{200});
}

/// Northwards at 2 m/s for 10 s.
Track under_way() {
  Track track;
  track.begin(fix(0, at(0, 0)));
  for (int second = 1; second <= 10; ++second) track.take(fix(second, at(2 * second, 0)));
  return track;
}

// 400 m beside where it was reckoned to be.
TEST(Track, TakesACorrectionForNoWay) {
  Track track = under_way();
  track.correct(fix(14, at(20, 400)));
  EXPECT_EQ(track.velocity_per_s(), at(2, 0));
  for (int second = 15; second <= 28; ++second) {
    track.take(fix(second, at(20 + 2 * (second - 14), 400)));
    EXPECT_EQ(track.velocity_per_s(), at(2, 0)) << second;
  }
  EXPECT_EQ(track.distance(), Meters{0}) << "20 m before and 28 m after";
  track.take(fix(29, at(50, 400)));
  EXPECT_EQ(track.distance(), Meters{50});
}

TEST(Track, TakesNoTurnFromBeforeACorrection) {
  Track track;
  track.begin(fix(0, at(0, 0)));
  track.take(fix(1, at(0, 0), 0, 1.0));
  track.correct(fix(5, at(0, 400), 0, 1.0));
  track.take(fix(7, at(4, 400), 0, 1.5));
  EXPECT_EQ(track.turn_rate(), RadiansPerSecond{0.25});
  track.take(fix(9, at(8, 400), 0, 2.5));
  EXPECT_EQ(track.turn_rate(), RadiansPerSecond{0.5}) << "1 rad since 7 s";
}

TEST(Track, TakesACorrectionForNoProgressAndCountsItFromThere) {
  for (const double to_north : {-400.0, 400.0}) {
    Track track = under_way();
    track.set_waypoint(at(1000, 0));
    track.take(fix(11, at(22, 0)));
    track.correct(fix(15, at(to_north, 0)));
    EXPECT_EQ(track.without_progress(Time{} + Duration::seconds(15)), Duration::seconds(4)) << "since 11 s";
    track.take(fix(18, at(to_north + 6, 0)));
    EXPECT_EQ(track.without_progress(Time{} + Duration::seconds(18)), Duration{}) << "6 m";
  }
}

TEST(Track, KnowsSinceWhenTheVehicleComesNoNearer) {
  Track track;
  track.begin(fix(0, at(0, 0)));
  EXPECT_EQ(track.without_progress(Time{} + Duration::seconds(100)), Duration{}) << "it has nowhere to go";
  track.take(fix(10, at(0, 0)));
  track.set_waypoint(at(1000, 0));
  track.take(fix(20, at(10, 0)));
  EXPECT_EQ(track.without_progress(Time{} + Duration::seconds(20)), Duration{});
  track.take(fix(30, at(14, 0)));
  EXPECT_EQ(track.without_progress(Time{} + Duration::seconds(30)), Duration::seconds(10)) << "4 m are none";
  track.take(fix(40, at(-500, 0)));
  track.take(fix(50, at(14, 0)));
  EXPECT_EQ(track.without_progress(Time{} + Duration::seconds(50)), Duration::seconds(30)) << "it was as near before";
  track.take(fix(60, at(15, 0)));
  EXPECT_EQ(track.without_progress(Time{} + Duration::seconds(60)), Duration{});
  track.set_waypoint(at(0, 0));
  EXPECT_EQ(track.without_progress(Time{} + Duration::seconds(65)), Duration::seconds(5)) << "since it has this one";
}

TEST(Track, ForgetsAnEarlierSearch) {
  Track track;
  track.begin(fix(0, at(0, 0)));
  track.take(fix(10, at(100, 0)));
  track.begin(fix(20, at(5, 5)));
  EXPECT_EQ(track.distance(), Meters{0});
  EXPECT_FALSE(track.velocity_per_s());
}

}  // namespace
}  // namespace earshot::safety
