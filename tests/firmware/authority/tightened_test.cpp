#include "firmware/authority/tightened.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace earshot::authority {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// 25 km square, 300 m deep of at most 400, 2 m/s, ten hours.
config::Mission mission() {
  return {.operating_area = {.south_west = {}, .north_east = {Meters{25'000}, Meters{25'000}}},
          .edge_margin = Meters{250},
          .search_depth = Meters{300},
          .max_depth = Meters{400},
          .search_speed = MetersPerSecond{2},
          .step_length = Meters{1000},
          .max_time = Duration::seconds(36'000),
          .navigation_timeout = Duration::seconds(5),
          .snr_timeout = Duration::seconds(5),
          .detection_threshold = Decibels{10}};
}

messages::OperatorLimits depth(double m) {
  return {.max_depth = Meters{m}};
}
messages::OperatorLimits speed(double mps) {
  return {.max_speed = MetersPerSecond{mps}};
}
messages::OperatorLimits time(double s) {
  return {.max_time_s = s};
}

/// A mission with these limits, or why it cannot have them.
Result<config::Mission> tightened(config::Mission mission, const messages::OperatorLimits& limits) {
  const Status status = tighten(mission, limits);
  return status == Status::kOk ? Result<config::Mission>(mission) : Result<config::Mission>(status);
}

TEST(Tightened, HasTheLimitsThatAreSaidAndKeepsTheRest) {
  config::Mission expected = mission();
  expected.max_depth = Meters{200};
  expected.search_depth = Meters{150};  // half, as its limit
  EXPECT_EQ(tightened(mission(), depth(200)).value(), expected);
  expected = mission();
  expected.search_speed = MetersPerSecond{1.5};
  EXPECT_EQ(tightened(mission(), speed(1.5)).value(), expected);
  expected = mission();
  expected.max_time = Duration::seconds(1800);
  EXPECT_EQ(tightened(mission(), time(1800)).value(), expected);
}

TEST(Tightened, MayBeAsItWasAndNeverLooser) {
  EXPECT_EQ(tightened(mission(), depth(400)).value(), mission());
  for (const auto& limits : {depth(400.001), depth(kInfinity), speed(2.001), speed(kInfinity), time(36'000.001), time(kInfinity)})
    EXPECT_EQ(tightened(mission(), limits).status(), Status::kOutOfRange);
  messages::OperatorLimits mixed = depth(100);
  mixed.max_speed = MetersPerSecond{3};
  EXPECT_EQ(tightened(mission(), mixed).status(), Status::kOutOfRange) << "one that is looser is refused with all others";
}

TEST(Tightened, IsNothingWithoutALimitOrWithoutRoom) {
  EXPECT_EQ(tightened(mission(), {}).status(), Status::kOutOfRange);
  for (const auto& limits : {depth(0), depth(-1), depth(-kInfinity), speed(0), speed(-1), time(0), time(-1), time(1e-7)})
    EXPECT_EQ(tightened(mission(), limits).status(), Status::kOutOfRange);
}

TEST(Tightened, MustStillBeAMissionThatTheVehicleCanFly) {
  config::Mission against_current = mission();
  against_current.safety.vehicle.max_speed = MetersPerSecond{3};
  against_current.safety.vehicle.max_current = MetersPerSecond{1};
  EXPECT_TRUE(tightened(against_current, speed(1.25)).ok());
  EXPECT_EQ(tightened(against_current, speed(0.75)).status(), Status::kOutOfRange) << "the current would carry it away";
}

TEST(Tightened, KeepsTheSearchAsFarFromItsLimitAsItWasUpToFiveMetres) {
  const auto search_depth_m = [](double search_m, double max_m, double tighter_m) {
    config::Mission deep = mission();
    deep.search_depth = Meters{search_m};
    deep.max_depth = Meters{max_m};
    return tightened(deep, depth(tighter_m)).value().search_depth.value;
  };
  EXPECT_EQ(search_depth_m(300, 310, 100), 95.0) << "by share 96.8";
  EXPECT_EQ(search_depth_m(300, 302, 100), 98.0);
  EXPECT_EQ(search_depth_m(300, 302, 3), 1.5) << "half of what there is";
  EXPECT_EQ(search_depth_m(50, 400, 300), 37.5) << "by share";
}

TEST(Tightened, LeavesTheSpeedThatTheVehicleNeedsToObeyItsRudders) {
  config::Mission glides = mission();
  glides.safety.vehicle.hold_speed = MetersPerSecond{0.8};
  EXPECT_TRUE(tightened(glides, speed(0.8)).ok());
  EXPECT_EQ(tightened(glides, speed(0.7)).status(), Status::kOutOfRange);
}

TEST(Tightened, MayForestallARuleOfTheMissionsOwn) {
  config::Mission warned = mission();
  ASSERT_EQ(warned.safety.rules.push_back({.condition = config::Condition::kDepth,
                                           .limit = 350,
                                           .persistence = Duration::seconds(10),
                                           .response = config::Response::kWarn}),
            Status::kOk);
  EXPECT_TRUE(tightened(warned, depth(340)).ok()) << "the vehicle comes up before it would have been warned of";
}

TEST(Tightened, IsAsItWasWhereItsLimitsAreRefused) {
  config::Mission refused = mission();
  messages::OperatorLimits mixed = depth(100);
  mixed.max_time_s = 40'000;
  for (const auto& limits : {mixed, depth(0), speed(3), time(1e-7)}) {
    EXPECT_EQ(tighten(refused, limits), Status::kOutOfRange);
    EXPECT_EQ(refused, mission());
  }
  config::Mission glides = mission();
  glides.safety.vehicle.hold_speed = MetersPerSecond{0.8};
  const config::Mission before = glides;
  messages::OperatorLimits all = depth(200);
  all.max_time_s = 1800;
  all.max_speed = MetersPerSecond{0.7};
  EXPECT_EQ(tighten(glides, all), Status::kOutOfRange) << "after all of them were put into it";
  EXPECT_EQ(glides, before);
}

}  // namespace
}  // namespace earshot::authority
