#include "firmware/safety/depth_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "tests/firmware/place.hpp"

namespace earshot::safety {
namespace {

/// A vehicle that needs 1 m/s to come up and says to make 0.5 m/s upwards; each second it is told something, and says how deep it is.
class Depths : public testing::Test {
 protected:
  void second(double told_m, double says_m, double speed_mps = 2.0) {
    now_ = now_ + Duration::seconds(1);
    estimate_.take({.time = now_, .position = at(0, 0), .depth = Meters{says_m}, .heading = {}, .speed = {}}, vehicle_);
    estimate_.tell(now_, {.heading = {}, .speed = MetersPerSecond{speed_mps}, .depth = Meters{told_m}, .waypoint = {}}, vehicle_);
  }
  void seconds(int count, double told_m, double says_m, double speed_mps = 2.0) {
    for (int i = 0; i < count; ++i) second(told_m, says_m, speed_mps);
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

// From 300 m, and 25 m more while it turns up.
TEST_F(Depths, CallsAVehicleUpWhenItSaysSoAndHadTheTime) {
  seconds(200, 300, 300);
  const int s = seconds_to_come_up();
  EXPECT_GE(s, 650);
  EXPECT_LE(s, 652);
}

// The reproduction of a vehicle that was lost: 0 m at 300 m, and an ABORT.
TEST_F(Depths, CallsNobodyUpWhoSaysZeroAllTheTime) {
  seconds(200, 300, 0);
  EXPECT_EQ(estimate_.deepest(), Meters{300}) << "it was told so for long enough";
  const int s = seconds_to_come_up(0);
  EXPECT_GE(s, 650) << "the time that it takes from 325 m";
  EXPECT_LE(s, 652);
}

TEST_F(Depths, GoesByTheTimeAloneWhereTheDepthIsStuckBelow) {
  seconds(200, 300, 300);
  const int s = seconds_to_come_up(300, 300);
  EXPECT_GE(s, 3250) << "325 m at 0.1 m/s";
  EXPECT_LE(s, 3252);
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

// Under way for ten seconds: it may be 30 m deep, 3 m more while it turns up.
TEST_F(Depths, TakesAVehicleToBeNoDeeperThanItCanHaveSunk) {
  seconds(11, 300, 0);
  EXPECT_EQ(estimate_.deepest(), Meters{30});
  const int s = seconds_to_come_up(0);
  EXPECT_LE(s, 75);
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
  EXPECT_LE(s, 62);
}

TEST_F(Depths, IsAtTheSurfaceWhereTheVehicleSaysThatItsAntennaIsOut) {
  vehicle_.surface_depth = Meters{0.5};
  seconds(200, 300, 300);
  EXPECT_GT(seconds_to_come_up(300, 0.6), 3200) << "by the time alone";
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

TEST_F(Depths, AsksNobodyToDiveWhoIsToldToStop) {
  second(300, 0);
  seconds(5000, 300, 0, 0);
  EXPECT_EQ(estimate_.unexplained(), Meters{0});
}

}  // namespace
}  // namespace earshot::safety
