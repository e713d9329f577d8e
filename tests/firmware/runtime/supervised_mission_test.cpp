#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

// What the safety supervisor makes of a mission: GIVEN a search under way, WHEN something is wrong, THEN the vehicle does as its rules say.

using config::Condition;
using config::Response;

config::Polygon square(double south, double west, double side, double more) {
  config::Polygon polygon;
  for (const NorthEast corner : {at(south - more, west - more), at(south + side + more, west - more),
                                 at(south + side + more, west + side + more), at(south - more, west + side + more)})
    static_cast<void>(polygon.push_back(corner));
  return polygon;
}

/// The paper's mission with a fence about its area, for a vehicle that turns on the spot, in water that stands still.
config::Mission fenced_mission() {
  config::Mission mission = paper_mission();
  mission.safety.fence = config::Fence{
      .inside = square(-5000, 1000, 25000, 0), .save = square(-5000, 1000, 25000, 100), .halt = square(-5000, 1000, 25000, 200)};
  mission.safety.safe_point = at(7000, 12000);
  mission.safety.vehicle.max_speed = MetersPerSecond{3};
  return mission;
}

config::Mission with_rule(const config::Rule& rule) {
  config::Mission mission = fenced_mission();
  EXPECT_EQ(mission.safety.rules.push_back(rule), Status::kOk);
  return mission;
}

const messages::SafetyEvent* event_of(const Outputs& outputs, Condition condition) {
  for (const messages::SafetyEvent& event : outputs.safety_events) {
    if (event.condition == condition) return &event;
  }
  return nullptr;
}

TEST(SupervisedMission, GoesOnAfterAStrayFix) {
  Rig rig = under_way(fenced_mission());
  messages::Navigation stray = rig.navigation_at(rig.now);
  stray.position = at(0, 0);
  rig.take(stray);
  for (int i = 0; i < 100; ++i) rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  EXPECT_EQ(rig.counters().navigation_refused, 1U);
}

TEST(SupervisedMission, AbortsWhenTwoSendersTellOfPlacesFarApartForTenSeconds) {
  Rig rig = under_way(fenced_mission());
  for (int i = 0; i < 11 && rig.state() == MissionState::kSearch; ++i) {
    messages::Navigation other = rig.navigation_at(rig.now);
    other.position = other.position + at(10'000, 0);
    rig.take(other);
    rig.sail();
    EXPECT_EQ(rig.state(), i < 10 ? MissionState::kSearch : MissionState::kAbort) << i;
  }
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kSafetyRule);
  ASSERT_NE(event_of(rig.outputs, Condition::kNavigationJump), nullptr);
}

/// With an acoustic fix from a place where the vehicle is not every `period_s`.
/// @return the second in which the search ended, counted from the first of them; none within ten minutes
std::optional<int> end_with_second_sender(int period_s) {
  Rig rig = under_way(fenced_mission());
  for (int s = 0; s < 600; ++s) {
    messages::Navigation other = rig.navigation_at(rig.now);
    other.position = other.position + at(4'000, 0);
    if (s % period_s == 0) rig.take(other);
    rig.sail();
    if (rig.state() == MissionState::kAbort) return s;
  }
  return std::nullopt;
}

// It is one sender when three of its fixes have gone on from each other; 10 s later nobody knows where the vehicle is.
TEST(SupervisedMission, AbortsWhenASlowSenderGoesOnTellingOfAPlaceFarOff) {
  for (const int period_s : {1, 2}) EXPECT_EQ(end_with_second_sender(period_s), 10) << "remembered from one to the next";
  for (const int period_s : {10, 30}) EXPECT_EQ(end_with_second_sender(period_s), 2 * period_s + 10) << period_s;
  EXPECT_EQ(end_with_second_sender(4), 2 * 4 + 10 - 2) << "the first two count two seconds each, less half of two seconds each";
  EXPECT_EQ(end_with_second_sender(5), 2 * 5 + 10 - 1) << "less half of three";
  EXPECT_EQ(end_with_second_sender(40), std::nullopt) << "stray fixes";
}

TEST(SupervisedMission, AbortsWhenFixesFreezeForLongerThanTheyMayBeOld) {
  Rig rig = under_way(fenced_mission());
  const NorthEast frozen = rig.position;
  for (int i = 1; i <= 6; ++i) {
    rig.position = frozen;
    rig.step({.navigation = rig.navigation_at(rig.now + Duration::seconds(1)),
              .snr = messages::SnrMeasurement{.time = rig.now + Duration::seconds(1), .snr = rig.snr}});
    EXPECT_EQ(rig.state(), i <= 5 ? MissionState::kSearch : MissionState::kAbort) << i;
  }
  EXPECT_EQ(rig.end_reason(), EndReason::kSafetyRule);
}

TEST(SupervisedMission, AbortsWhenTheVehicleItselfIsDeeperThanItMayBe) {
  Rig rig = under_way(fenced_mission());
  for (int i = 0; i <= 5; ++i) {
    EXPECT_EQ(rig.state(), MissionState::kSearch) << i;
    rig.move();
    rig.depth = Meters{900};
    rig.step({.navigation = rig.navigation_at(rig.now + Duration::seconds(1)),
              .snr = messages::SnrMeasurement{.time = rig.now + Duration::seconds(1), .snr = rig.snr}});
  }
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  const messages::SafetyEvent* event = event_of(rig.outputs, Condition::kDepth);
  ASSERT_NE(event, nullptr);
  EXPECT_GE(event->measure, 900.0);
  EXPECT_EQ(event->limit, 320.0);
}

// 400 m further east than it was reckoned, 200 m from the fence: those 400 m are no way that it made, and no way that it goes.
TEST(SupervisedMission, TakesACorrectionOfItsPlaceForNoWayThatItMade) {
  Rig rig(*policy_that_goes(kNorthward), with_rule({.condition = Condition::kDistanceTravelled,
                                                    .limit = 300.0,
                                                    .persistence = {},
                                                    .response = Response::kWarn,
                                                    .is_latched = false}));
  rig.position = at(7000, 25'500);
  rig.sail(Order::kStart);
  for (int i = 0; i < 10; ++i) {
    rig.sail();
    EXPECT_TRUE(rig.outputs.safety_events.empty()) << "the way to its start is none of this search's";
  }
  rig.position = rig.position + at(0, 400);
  for (int i = 0; i < 60; ++i) {
    rig.sail();
    EXPECT_TRUE(rig.outputs.safety_events.empty()) << i;
  }
  EXPECT_EQ(rig.outputs.health.counters.navigation_refused, 3U) << "and then believed";
}

// A leg takes 500 s; fixes creep, so that they are not frozen.
TEST(SupervisedMission, AbortsAVehicleThatNeverMoves) {
  Rig rig = under_way(fenced_mission());
  int seconds = 0;
  for (; rig.state() == MissionState::kSearch && seconds < 10'000; ++seconds) {
    rig.position = rig.position + at(0, seconds % 2 == 0 ? 0.5 : -0.5);
    rig.step({.navigation = rig.navigation_at(rig.now + Duration::seconds(1)),
              .snr = messages::SnrMeasurement{.time = rig.now + Duration::seconds(1), .snr = rig.snr}});
  }
  EXPECT_NEAR(seconds, 1500, 10);
  EXPECT_EQ(rig.end_reason(), EndReason::kSafetyRule);
}

// A current that nobody foretold carries it out by 3 m/s, eastwards, faster than it can steer against it, until it is beyond the fence.
TEST(SupervisedMission, SteersBackIntoTheFenceAndThenSearchesOn) {
  Rig rig(*policy_that_goes(kNorthward), fenced_mission());
  rig.position = at(7000, 25'950);
  rig.sail(Order::kStart);
  double farthest = 0.0;
  bool was_steered_back = false;
  bool searched_on = false;
  for (int i = 0; i < 600; ++i) {
    if (rig.position.east.value < 26'120 && !was_steered_back) rig.position = rig.position + at(0, 3);
    rig.sail();
    farthest = std::max(farthest, rig.position.east.value);
    if (rig.outputs.health.response == Response::kSteerBack) was_steered_back = true;
    if (was_steered_back && rig.outputs.decision) searched_on = true;
  }
  EXPECT_TRUE(was_steered_back);
  EXPECT_TRUE(searched_on);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  EXPECT_LT(farthest, 26'110);
  EXPECT_LE(rig.position.east.value, 26'000);
}

TEST(SupervisedMission, ReturnsToTheSafePointAndStaysThereWhenTheBatteryIsLow) {
  Rig rig = under_way(
      with_rule({.condition = Condition::kBattery, .limit = 20.0, .persistence = {}, .response = Response::kReturn, .is_latched = true}));
  for (int i = 0; i < 400; ++i) rig.sail();
  rig.take(messages::VehicleStatus{.time = rig.now, .battery_percent = 19});
  for (int i = 0; i < 600; ++i) {
    rig.sail();
    EXPECT_FALSE(rig.outputs.decision) << "it searches no more";
  }
  EXPECT_LT(range_between(rig.position, at(7000, 12000)), Meters{21});
  EXPECT_EQ(rig.setpoint.speed, MetersPerSecond{0});
  EXPECT_EQ(rig.setpoint.depth, Meters{300});
  EXPECT_EQ(rig.outputs.health.response, Response::kReturn);
}

TEST(SupervisedMission, DropsItsWeightWhenThereIsALeakAndARuleSaysSo) {
  Rig rig = under_way(with_rule({.condition = Condition::kLeak,
                                 .limit = 0,
                                 .persistence = Duration::seconds(2),
                                 .response = Response::kRelease,
                                 .is_latched = true}));
  rig.take(messages::VehicleStatus{.time = rig.now, .has_leak = true});
  rig.sail();
  rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kSearch) << "a drop on a sensor is no leak";
  rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_TRUE(rig.setpoint.release_weight);
  EXPECT_EQ(rig.setpoint.depth, Meters{0});
  rig.take(messages::VehicleStatus{.time = rig.now, .has_leak = false});
  rig.sail();
  EXPECT_TRUE(rig.setpoint.release_weight) << "it is latched";
}

config::Mission with_release() {
  config::Mission mission = with_rule(
      {.condition = Condition::kLeak, .limit = 0, .persistence = Duration::seconds(2), .response = Response::kRelease, .is_latched = true});
  mission.max_steps = 2;
  return mission;
}

/// A leak in a mission that is over.
void expect_release_of(Rig& rig, EndReason reason) {
  const MissionState state = rig.state();
  ASSERT_EQ(rig.end_reason(), reason);
  for (int i = 0; i < 20; ++i) rig.sail();
  EXPECT_FALSE(rig.setpoint.release_weight);
  rig.take(messages::VehicleStatus{.time = rig.now, .has_leak = true});
  for (int i = 0; i < 2; ++i) rig.sail();
  EXPECT_FALSE(rig.setpoint.release_weight);
  rig.sail();
  EXPECT_TRUE(rig.setpoint.release_weight);
  EXPECT_EQ(rig.setpoint.depth, Meters{0});
  EXPECT_NE(event_of(rig.outputs, Condition::kLeak), nullptr);
  EXPECT_EQ(rig.outputs.health.response, Response::kRelease);
  EXPECT_EQ(rig.state(), state) << "it ended as it did";
  EXPECT_EQ(rig.end_reason(), reason);
}

TEST(SupervisedMission, DropsItsWeightWhenTheLeakComesAfterAnOperatorsAbort) {
  Rig rig = under_way(with_release());
  rig.sail(Order::kAbort);
  expect_release_of(rig, EndReason::kOperatorAbort);
}

TEST(SupervisedMission, DropsItsWeightWhenTheLeakComesAfterAnotherRulesAbort) {
  Rig rig = under_way(with_release());
  for (int i = 0; i < 6; ++i) rig.step({.snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}});
  expect_release_of(rig, EndReason::kNavigationStale);
}

TEST(SupervisedMission, DropsItsWeightWhenTheLeakComesAfterItIsDone) {
  Rig rig = under_way(with_release());
  while (rig.state() == MissionState::kSearch) rig.sail();
  expect_release_of(rig, EndReason::kStepsUsedUp);
}

TEST(SupervisedMission, TellsNothingOfItsOtherRulesWhenItIsOver) {
  Rig rig = under_way(with_rule({.condition = Condition::kAltitude, .limit = 50.0, .persistence = {}, .response = Response::kWarn}));
  rig.sail(Order::kAbort);
  rig.take(messages::VehicleStatus{.time = rig.now, .altitude = Meters{40}});
  for (int i = 0; i < 60; ++i) {
    rig.step({});  // no fix, no SNR
    EXPECT_TRUE(rig.outputs.safety_events.empty()) << i;
  }
  EXPECT_EQ(rig.end_reason(), EndReason::kOperatorAbort);
}

TEST(SupervisedMission, SaysNothingAfterASearchThatOnlyListened) {
  Rig rig(*policy_that_goes(kNorthward), with_release());
  rig.sail(Order::kListen);
  rig.sail(Order::kAbort);
  rig.take(messages::VehicleStatus{.time = rig.now, .has_leak = true});
  for (int i = 0; i < 5; ++i) {
    rig.sail();
    EXPECT_TRUE(rig.outputs.safety_events.empty());
    EXPECT_FALSE(rig.outputs.setpoint);
  }
}

// 300 m, and 25 m in the minute in which it turns up, at 0.1 m/s are 3310 s, from the ABORT on; its circle is 20 m in radius.
TEST(SupervisedMission, BringsATorpedoUpWithoutFixesRoundACircleAndThenStops) {
  config::Mission mission = fenced_mission();
  mission.safety.vehicle.ascent_speed = MetersPerSecond{1};
  Rig rig = under_way(mission);
  NorthEast from = rig.position;
  double farthest_m = 0.0;
  for (int i = 1; i <= 3400; ++i) {
    rig.step({.snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}});
    if (i == 6) from = rig.position;
    rig.move();
    if (i >= 6) farthest_m = std::max(farthest_m, range_between(rig.position, from).value);
    EXPECT_EQ(rig.state(), i <= 5 ? MissionState::kSearch : MissionState::kAbort) << i;
    if (i >= 6) {
      EXPECT_EQ(rig.setpoint.speed.value, i <= 3316 ? 1.0 : 0.0) << i;
    }
  }
  EXPECT_NEAR(farthest_m, 40.0, 1.0) << "straight on it would be 3 km";
}

TEST(SupervisedMission, BringsATorpedoUpRoundACircleWhenItsFixesFreeze) {
  config::Mission mission = fenced_mission();
  mission.safety.vehicle.ascent_speed = MetersPerSecond{1};
  Rig rig = under_way(mission);
  const messages::Navigation frozen = rig.navigation_at(rig.now);
  NorthEast from = rig.position;
  double farthest_m = 0.0;
  for (int i = 1; i <= 1000; ++i) {
    messages::Navigation fix = frozen;
    fix.time = rig.now + Duration::seconds(1);
    rig.step({.navigation = fix, .snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}});
    rig.move();
    if (i == 10) from = rig.position;
    if (i > 10) farthest_m = std::max(farthest_m, range_between(rig.position, from).value);
  }
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_NEAR(farthest_m, 40.0, 1.0);
}

TEST(SupervisedMission, HearsAnOperatorInVerifiedOrdersOnly) {
  config::Mission mission =
      with_rule({.condition = Condition::kOperatorAge, .limit = 60, .persistence = {}, .response = Response::kHold, .is_latched = false});
  mission.authority.needs_verified_commands = true;
  Rig rig(*policy_that_goes(kNorthward), mission);
  const auto give = [&rig](bool is_verified, std::uint32_t number) {
    messages::OperatorCommand command = command_of(number == 1 ? Order::kStart : Order::kResume, rig.now, number);
    command.is_verified = is_verified;
    rig.take(command);
  };
  give(true, 1);
  for (int i = 0; i < 60; ++i) {
    rig.sail();
    give(false, 2);
  }
  EXPECT_EQ(rig.outputs.health.response, Response::kWarn);
  rig.sail();
  EXPECT_EQ(rig.outputs.health.response, Response::kHold) << "none that it knows was heard for a minute";
  give(true, 2);
  rig.sail();
  EXPECT_EQ(rig.outputs.health.response, Response::kWarn);
}

TEST(SupervisedMission, KeepsTheWeightInAnOperatorsAbort) {
  Rig rig = under_way(fenced_mission());
  rig.sail(Order::kAbort);
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_FALSE(rig.setpoint.release_weight);
}

TEST(SupervisedMission, WarnsAndGoesOn) {
  Rig rig = under_way(with_rule({.condition = Condition::kAltitude, .limit = 50.0, .persistence = {}, .response = Response::kWarn}));
  rig.take(messages::VehicleStatus{.time = rig.now, .altitude = Meters{40}});
  rig.sail();
  const messages::SafetyEvent* event = event_of(rig.outputs, Condition::kAltitude);
  ASSERT_NE(event, nullptr);
  EXPECT_TRUE(event->begins);
  EXPECT_EQ(event->measure, 40.0);
  EXPECT_EQ(rig.outputs.health.response, Response::kWarn);
  EXPECT_EQ(rig.setpoint.speed, MetersPerSecond{2});
}

TEST(SupervisedMission, RefusesAndCountsAStatusThatIsOldOrOlderThanTheLast) {
  Rig rig = under_way(fenced_mission());
  rig.take(messages::VehicleStatus{.time = rig.now});
  rig.take(messages::VehicleStatus{.time = rig.now + Duration::milliseconds(-1)});
  rig.take(messages::AutopilotStatus{.time = rig.now + Duration::seconds(-31)});
  rig.take(messages::HydrophoneStatus{.time = rig.now + Duration::seconds(31)});
  rig.sail();
  EXPECT_EQ(rig.counters().status_refused, 3U);
}

TEST(SupervisedMission, IsRefusedWithAFenceThatIsNone) {
  config::Mission mission = fenced_mission();
  mission.safety.fence->halt = mission.safety.fence->save;
  const Rig rig(*policy_that_goes(kNorthward), mission);
  EXPECT_EQ(rig.configured, Status::kOutOfRange);
}

}  // namespace
}  // namespace earshot::runtime
