#include "firmware/safety/depth_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "tests/firmware/place.hpp"

namespace earshot::safety {
namespace {

/// A vehicle that needs 1 m/s to come up and says to make 0.5 m/s upwards; each second it is told something, and says how deep it is.
class Depths : public testing::Test {
 protected:
  void second(double ordered_m, double says_m, double speed_mps = 2.0) {
    now_ = now_ + Duration::seconds(1);
    estimate_.take({.time = now_, .position = at(0, 0), .depth = Meters{says_m}, .heading = {}, .speed = {}});
    estimate_.note_order(now_, {.heading = {}, .speed = MetersPerSecond{speed_mps}, .depth = Meters{ordered_m}, .waypoint = {}}, vehicle_);
  }
  void seconds(int count, double ordered_m, double says_m, double speed_mps = 2.0) {
    for (int i = 0; i < count; ++i) second(ordered_m, says_m, speed_mps);
  }
  /// Is told to come up, and says that it does at 0.5 m/s. @return the seconds until it counts as up, 10,000 at most
  int seconds_to_come_up(double from_m = 300.0, double says_after_m = 0.0) {
    int s = 0;
    for (; s < 10'000 && !estimate_.is_up(vehicle_); ++s) second(0.0, std::max(from_m - 0.5 * s, says_after_m), 1.0);
    return s;
  }
  [[nodiscard]] static config::VehicleLimits torpedo() {
    config::VehicleLimits vehicle;
    vehicle.ascent_speed = MetersPerSecond{1.0};
    vehicle.ascent_rate = MetersPerSecond{0.5};
    return vehicle;
  }

  config::VehicleLimits vehicle_ = torpedo();
  DepthEstimate estimate_;
  Time now_{1'000'000};
};

// From 300 m, and 25 m more while it turns up, which takes a minute.
TEST_F(Depths, CallsAVehicleUpWhenItSaysSoAndHadTheTime) {
  seconds(200, 300, 300);
  const int s = seconds_to_come_up();
  EXPECT_GE(s, 710);
  EXPECT_LE(s, 712);
}

// The reproduction of a vehicle that was lost: 0 m at 300 m, and an ABORT.
TEST_F(Depths, CallsNobodyUpWhoSaysZeroAllTheTime) {
  seconds(200, 300, 0);
  EXPECT_EQ(estimate_.deepest(), Meters{300}) << "it was told so for long enough";
  const int s = seconds_to_come_up(0);
  EXPECT_GE(s, 710) << "the time that it takes from 325 m";
  EXPECT_LE(s, 712);
}

TEST_F(Depths, GoesByTheTimeAloneWhereTheDepthIsStuckBelow) {
  seconds(200, 300, 300);
  const int s = seconds_to_come_up(300, 300);
  EXPECT_GE(s, 3310) << "325 m at 0.1 m/s";
  EXPECT_LE(s, 3312);
}

// At 0.05 m/s: slower than any vehicle should.
TEST_F(Depths, LetsOneGoOnThatStillComesUp) {
  seconds(200, 300, 300);
  for (int s = 0; s < 5900; ++s) {
    second(0, 300 - 0.05 * s, 1);
    ASSERT_FALSE(estimate_.is_up(vehicle_)) << s;
  }
}

TEST_F(Depths, CountsNoTimeInWhichItIsTooSlowToComeUp) {
  seconds(200, 300, 300);
  seconds(5000, 0, 0, 0.9);
  EXPECT_FALSE(estimate_.is_up(vehicle_));
}

TEST_F(Depths, CallsAVehicleUpThatWasNeverDeepAfterAMoment) {
  seconds(3, 0, 0.5, 1);
  EXPECT_TRUE(estimate_.is_up(vehicle_));
}

// Under way for ten seconds: it may be 30 m deep, 33 when it is told to come up, and a tenth more within the minute in which it turns up.
TEST_F(Depths, TakesAVehicleToBeNoDeeperThanItCanHaveSunk) {
  seconds(11, 300, 0);
  EXPECT_EQ(estimate_.deepest(), Meters{30});
  const int s = seconds_to_come_up(0);
  EXPECT_GE(s, 132);
  EXPECT_LE(s, 135);
}

TEST_F(Depths, BeginsAnewWithADepthThatRisesAgain) {
  seconds(200, 300, 300);
  ASSERT_GT(seconds_to_come_up(), 0);
  seconds(20, 0, 3.9, 0);
  EXPECT_TRUE(estimate_.is_up(vehicle_)) << "waves";
  second(0, 30, 0);
  EXPECT_TRUE(estimate_.is_up(vehicle_)) << "one fix may be wrong";
  second(0, 30, 0);
  EXPECT_FALSE(estimate_.is_up(vehicle_));
  const int s = seconds_to_come_up(30);
  EXPECT_LE(s, 122);
}

// What an expert found: a true rate, but a vehicle that takes its minute to turn up, and a depth stuck at 0.
TEST_F(Depths, CallsNobodyUpWhoTakesAMinuteToTurnUp) {
  for (const auto& [from_m, rate_mps] : {std::pair{20.0, 0.3}, {50.0, 1.0}, {300.0, 1.0}}) {
    estimate_ = {};
    vehicle_.ascent_rate = MetersPerSecond{rate_mps};
    seconds(200, from_m, 0);
    double true_m = from_m;
    for (int s = 0; s < 10'000 && !estimate_.is_up(vehicle_); ++s) {
      second(0, 0, 1);
      if (s > 60) true_m = std::max(true_m - rate_mps, 0.0);
    }
    EXPECT_TRUE(estimate_.is_up(vehicle_));
    EXPECT_LE(true_m, 1.0) << from_m;
  }
}

// Likewise where it is told to go up, but not to the surface.
TEST_F(Depths, GrantsTheTimeToTurnUpToAVehicleThatIsToldAShallowerDepth) {
  seconds(200, 300, 0);
  seconds(60, 100, 0);
  EXPECT_EQ(estimate_.deepest(), Meters{300});
  seconds(100, 100, 0);
  EXPECT_NEAR(estimate_.deepest().value, 250, 1);
}

// Under ice, in a line or in water that sinks at 10 m; its depth says so.
TEST_F(Depths, LetsAVehicleThatIsHeldBelowTryAgainTenMinutesOfEveryHour) {
  vehicle_.ascent_rate = MetersPerSecond{0.3};
  seconds(200, 50, 50);
  int stopped = 0;
  for (int s = 0; s < 6 * 3600; ++s) {
    second(0, std::max(50 - 0.3 * s, 10.0), estimate_.is_up(vehicle_) ? 0 : 1);
    if (s >= 3600) stopped += estimate_.is_up(vehicle_) ? 1 : 0;
  }
  EXPECT_NEAR(stopped, 5 * 3000, 1200);
  for (int s = 0; s < 3600 && estimate_.is_up(vehicle_); ++s) second(0, 10, 0);
  int s = 0;
  for (; s < 10'000 && !estimate_.is_up(vehicle_); ++s) second(0, std::max(10 - 0.01 * s, 0.0), 1);
  EXPECT_GT(s, 790) << "as long as its depth falls, to where its antenna is out of the water";
  EXPECT_LT(s, 810);
}

TEST_F(Depths, TellsAVehicleToStopWhoseDepthDriftsDownForEver) {
  vehicle_.ascent_rate = config::kSlowestAscent;
  seconds(200, 300, 300);
  int stopped = 0;
  for (int s = 0; s < 86'400; ++s) {
    second(0, std::max(300 - 0.1 * s, 0.0) + 0.01 * s, estimate_.is_up(vehicle_) ? 0 : 1);
    stopped += estimate_.is_up(vehicle_) ? 1 : 0;
  }
  EXPECT_GT(stopped, 86'400 * 3 / 4);
}

// Two senders, of whom each turn hears the one that lies several times, and the honest one last: no rule sees the first.
TEST_F(Depths, CountsNoDepthThatIsTakenBackWithinTheTurn) {
  seconds(200, 300, 300);
  for (int s = 0; s < 100; ++s) {
    for (int i = 0; i < 3; ++i) estimate_.take({.time = now_, .position = at(0, 0), .depth = Meters{11'000}, .heading = {}, .speed = {}});
    second(300, 300);
  }
  EXPECT_EQ(estimate_.deepest(), Meters{300});
}

// Now 300 m, now the truth: it must not go round for ever.
TEST_F(Depths, TellsAVehicleToStopWhoseDepthSaysNowAndThenThatItIsBelow) {
  vehicle_.ascent_rate = config::kSlowestAscent;
  seconds(200, 300, 300);
  int stopped = 0;
  for (int s = 0; s < 86'400; ++s) {
    second(0, s % 20 < 10 ? 300 : std::max(300 - 0.1 * s, 0.0), estimate_.is_up(vehicle_) ? 0 : 1);
    stopped += estimate_.is_up(vehicle_) ? 1 : 0;
  }
  EXPECT_GT(stopped, 86'400 * 3 / 4);
}

// A second sender that pauses: at the surface it says 14 m for 8 s of every 58.
TEST_F(Depths, TellsAVehicleToStopThatIsSaidToSinkNowAndThen) {
  vehicle_.ascent_rate = MetersPerSecond{0.3};
  seconds(200, 300, 300);
  int stopped = 0;
  for (int s = 0; s < 86'400; ++s) {
    second(0, s % 58 < 8 ? 14 : std::max(300 - 0.3 * s, 0.0), estimate_.is_up(vehicle_) ? 0 : 1);
    stopped += estimate_.is_up(vehicle_) ? 1 : 0;
  }
  EXPECT_GT(stopped, 86'400 * 3 / 4);
}

TEST_F(Depths, RestsNotWhereItsDepthSaysThatItCameUpMeanwhile) {
  seconds(200, 300, 300);
  seconds(4000, 0, 10, 1);
  ASSERT_TRUE(estimate_.is_up(vehicle_));
  for (int m = 9; m > 0; --m) second(0, m, 0);
  seconds(10, 0, 0, 0);
  ASSERT_TRUE(estimate_.is_up(vehicle_));
  seconds(2, 0, 5, 0);
  EXPECT_FALSE(estimate_.is_up(vehicle_)) << "it sinks again";
}

TEST_F(Depths, BeginsWithADepthThatIsToldInPlaceOfOneThatIsMeasured) {
  estimate_ = DepthEstimate(Meters{100});
  EXPECT_EQ(estimate_.deepest(), Meters{100});
  int s = 0;
  for (; s < 10'000 && !estimate_.is_up(vehicle_); ++s) {
    now_ = now_ + Duration::seconds(1);
    estimate_.note_order(now_, {.heading = {}, .speed = MetersPerSecond{1}, .depth = Meters{0}, .waypoint = {}}, vehicle_);
  }
  EXPECT_NEAR(s, 60 + 2 * 110, 2) << "nobody tells a depth";
}

TEST_F(Depths, IsAtTheSurfaceWhereTheVehicleSaysThatItsAntennaIsOut) {
  vehicle_.surface_depth = Meters{0.5};
  seconds(200, 300, 300);
  const int s = seconds_to_come_up(300, 0.6);
  EXPECT_GT(s, 3200) << "by the time alone";
  EXPECT_LT(s, 10'000);
}

TEST_F(Depths, CountsADepthThatIsDeeperThanWasTold) {
  seconds(200, 300, 300);
  seconds(2, 300, 340);
  EXPECT_EQ(estimate_.deepest(), Meters{339.5}) << "it is told to go up";
  second(300, 900);
  EXPECT_EQ(estimate_.deepest(), Meters{339.5}) << "one fix may be wrong";
}

// 0 m when it was told 300: by 0.05 m/s it is 25 m above its order after 5500 s and 60 s more.
TEST_F(Depths, ExplainsADiveAsSlowAsAnyAndNoDepthThatStandsStill) {
  for (int s = 0; s < 6000; ++s) {
    second(300, std::min(0.05 * std::max(s - 50, 0), 300.0));
    ASSERT_EQ(estimate_.unexplained(), Meters{0}) << s;
  }
  estimate_ = {};
  int s = 0;
  for (; s < 10'000 && !(estimate_.unexplained() > Meters{0}); ++s) second(300, 0);
  EXPECT_GE(s, 560);
  EXPECT_LE(s, 563);
}

TEST_F(Depths, ExplainsNoDepthThatLeavesItsOrder) {
  seconds(200, 300, 300);
  second(300, 325);
  EXPECT_EQ(estimate_.unexplained(), Meters{0});
  second(300, 335);
  EXPECT_EQ(estimate_.unexplained(), Meters{10});
  second(300, 0);
  EXPECT_EQ(estimate_.unexplained(), Meters{275});
}

// In an outage of five minutes an autopilot lets it come up by 120 m.
TEST_F(Depths, ExplainsWhereTheFirstOrderAfterAnOutageFindsIt) {
  seconds(200, 300, 300);
  now_ = now_ + Duration::seconds(5);
  EXPECT_FALSE(estimate_.is_left_alone(now_));
  now_ = now_ + Duration::seconds(295);
  EXPECT_TRUE(estimate_.is_left_alone(now_));
  for (int s = 0; s < 300; ++s) {
    second(300, 180.0 + 0.4 * s);
    ASSERT_EQ(estimate_.unexplained(), Meters{0}) << s;
  }
  seconds(2400, 300, 300);
  second(300, 180);
  EXPECT_EQ(estimate_.unexplained(), Meters{95}) << "no longer";
}

// It needs speed to come up, and was told none for ten minutes: it is where it was.
TEST_F(Depths, CountsNoTimeInWhichNobodyToldItToComeUp) {
  seconds(200, 300, 300);
  seconds(100, 0, 0, 1);
  const Meters before = estimate_.deepest();
  now_ = now_ + Duration::seconds(600);
  second(0, 0, 1);
  EXPECT_EQ(estimate_.deepest(), before);
  EXPECT_FALSE(estimate_.is_up(vehicle_));
}

TEST_F(Depths, AsksNobodyToDiveWhoIsToldToStop) {
  second(300, 0);
  seconds(5000, 300, 0, 0);
  EXPECT_EQ(estimate_.unexplained(), Meters{0});
}

}  // namespace
}  // namespace earshot::safety
