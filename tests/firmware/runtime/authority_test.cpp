#include <gtest/gtest.h>

#include <algorithm>

#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

// What an operator's orders make of a mission: GIVEN a vehicle in some state, WHEN an order comes, THEN it commands or does not.

using config::Condition;
using messages::Authority;
using messages::CommandOutcome;

CommandOutcome outcome_of(const Outputs& outputs) {
  EXPECT_EQ(outputs.acknowledgements.size(), 1U);
  return outputs.acknowledgements.empty() ? CommandOutcome::kUnknownOrder : outputs.acknowledgements[0].outcome;
}

messages::OperatorCommand tightening(const Rig& rig, std::uint32_t number, const messages::OperatorLimits& limits) {
  messages::OperatorCommand command = command_of(Order::kTighten, rig.now, number);
  command.limits = limits;
  return command;
}

TEST(Listening, DecidesAndCommandsNothing) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.sail(Order::kListen);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  EXPECT_EQ(rig.outputs.health.authority, Authority::kListen);
  EXPECT_TRUE(rig.outputs.decision) << "what it would do";
  EXPECT_FALSE(rig.outputs.setpoint);
  // A leg of 1 km takes 500 s at 2 m/s: then it decides again, wherever the vehicle is.
  for (int i = 1; i < 500; ++i) {
    rig.sail();
    EXPECT_FALSE(rig.outputs.decision) << i;
    EXPECT_FALSE(rig.outputs.setpoint) << i;
  }
  rig.sail();
  ASSERT_TRUE(rig.outputs.decision);
  EXPECT_EQ(rig.outputs.decision->step, 1U);
  EXPECT_EQ(rig.outputs.health.decisions, 2U);
}

TEST(Listening, WatchesAVehicleThatOthersSteerWithoutCallingItStuck) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.sail(Order::kListen);
  for (int i = 0; i < 4 * 1500; ++i) rig.sail();  // no progress for four times as long as a search that commands may make none
  EXPECT_EQ(rig.state(), MissionState::kSearch);
}

TEST(Listening, HoldsNoWayPointAgainstAVehicleThatOthersSteer) {
  config::Mission mission = paper_mission();
  ASSERT_EQ(mission.safety.rules.push_back({.condition = config::Condition::kNoProgress,
                                            .limit = 100.0,
                                            .persistence = {},
                                            .response = config::Response::kWarn,
                                            .is_latched = false}),
            Status::kOk);
  Rig rig(*policy_that_goes(kNorthward), mission);
  rig.sail(Order::kListen);
  for (int i = 0; i < 300; ++i) {
    rig.sail();
    EXPECT_TRUE(rig.outputs.safety_events.empty()) << i;
  }
  EXPECT_EQ(rig.state(), MissionState::kSearch);
}

TEST(Listening, EndsWithoutAWordToTheAutopilot) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.sail(Order::kListen);
  rig.sail(Order::kAbort);
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_FALSE(rig.outputs.setpoint);
}

TEST(Refused, OrdersChangeNothingOfASearch) {
  Rig rig = under_way();
  for (const Order order : {Order::kStart, Order::kListen, Order::kResume}) {
    rig.sail(order);
    EXPECT_EQ(outcome_of(rig.outputs), CommandOutcome::kNotInThisState);
    EXPECT_FALSE(rig.outputs.decision);
    EXPECT_EQ(rig.outputs.setpoint->speed.value, 2.0);
  }
}

TEST(Listening, TakesTheVehicleFromWhereItIsOnceToldToStart) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.sail(Order::kListen);
  for (int i = 0; i < 100; ++i) {
    rig.position = rig.position + at(0, 2);  // others steer it to the east
    rig.sail();
  }
  rig.sail(Order::kStart);
  EXPECT_EQ(outcome_of(rig.outputs), CommandOutcome::kObeyed);
  EXPECT_EQ(rig.outputs.health.authority, Authority::kCommand);
  ASSERT_TRUE(rig.outputs.decision);
  EXPECT_EQ(rig.outputs.decision->position, rig.position);
  ASSERT_TRUE(rig.outputs.setpoint);
  EXPECT_EQ(rig.outputs.setpoint->waypoint, rig.position + at(1000, 0));
  const NorthEast before = rig.position;
  rig.sail();
  EXPECT_GT(rig.position.north.value, before.north.value);
}

TEST(Paused, HoldsItsPlaceForAsLongAsItMayAndGoesOnFromThere) {
  Rig rig = under_way();
  rig.sail(Order::kPause);
  EXPECT_EQ(outcome_of(rig.outputs), CommandOutcome::kObeyed);
  EXPECT_TRUE(rig.outputs.health.is_paused);
  const NorthEast place = rig.position;
  for (int i = 0; i < 2 * 1500; ++i) {  // twice as long as a search may make no progress
    rig.sail();
    ASSERT_TRUE(rig.outputs.setpoint);
    EXPECT_EQ(rig.outputs.setpoint->speed.value, 0.0);
    EXPECT_FALSE(rig.outputs.decision);
  }
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  EXPECT_LE(range_between(rig.position, place).value, 2.0);
  rig.sail(Order::kResume);
  EXPECT_FALSE(rig.outputs.health.is_paused);
  ASSERT_TRUE(rig.outputs.decision);
  EXPECT_EQ(rig.outputs.setpoint->speed.value, 2.0);
}

// An operator's program that says no issuer and numbers by its clock; then an outage, and the safety record's PAUSE.
TEST(Paused, ByTheVehiclesOwnSafetyRecordWhateverNumbersAnOperatorUsed) {
  Rig rig = under_way();
  const auto give = [&rig](std::uint8_t port, Order order, std::uint32_t number) {
    messages::OperatorCommand command = command_of(order, rig.now, number);
    command.issuer = 0;
    rig.runtime->take({.arrival = rig.now, .port = port, .sequence = rig.sequence++, .value = command});
    rig.sail();
    return outcome_of(rig.outputs);
  };
  EXPECT_EQ(give(1, Order::kPause, 1'795'000'000), CommandOutcome::kObeyed);
  EXPECT_EQ(give(1, Order::kResume, 1'795'000'001), CommandOutcome::kObeyed);
  EXPECT_EQ(give(messages::kOwnPort, Order::kPause, 37), CommandOutcome::kObeyed);
  EXPECT_TRUE(rig.outputs.health.is_paused);
  EXPECT_EQ(give(1, Order::kResume, 1'795'000'002), CommandOutcome::kObeyed) << "his own numbers stay his";
  EXPECT_FALSE(rig.outputs.health.is_paused);
}

TEST(Paused, IsStillWatched) {
  Rig rig = under_way();
  rig.sail(Order::kPause);
  for (int i = 0; i < 6; ++i) rig.step({.snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}});
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kNavigationStale);
}

TEST(Tightened, HoldsFromTheNextSetPointOn) {
  Rig rig = under_way();
  ASSERT_EQ(rig.outputs.setpoint->depth.value, 300.0);
  rig.take(tightening(rig, 2, {.max_depth = Meters{100}, .max_speed = MetersPerSecond{1}}));
  rig.sail();
  EXPECT_EQ(outcome_of(rig.outputs), CommandOutcome::kObeyed);
  EXPECT_EQ(rig.outputs.setpoint->depth.value, 300.0 * 100.0 / 320.0);
  EXPECT_EQ(rig.outputs.setpoint->speed.value, 1.0);
}

TEST(Tightened, DoesNotEndAMissionThatIsOnItsWayUpAndDoesOneThatGoesDownAgain) {
  Rig rig = under_way();
  rig.take(tightening(rig, 2, {.max_depth = Meters{100}}));
  const auto at_depth = [&rig](double depth) {
    rig.move();
    rig.depth = Meters{depth};
    const Time measured = rig.now + Duration::seconds(1);
    rig.step({.navigation = rig.navigation_at(measured), .snr = messages::SnrMeasurement{.time = measured, .snr = rig.snr}});
  };
  for (double depth = 300; depth > 95; depth -= 0.5) at_depth(depth);
  EXPECT_EQ(rig.state(), MissionState::kSearch) << "up from 300 m at half a metre a second";
  for (int i = 0; i < 30; ++i) at_depth(95);
  for (int i = 0; i < 30 && rig.state() == MissionState::kSearch; ++i) at_depth(110);
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kSafetyRule);
}

TEST(Tightened, KeepsTheOldDepthUntilTheNewOneIsReached) {
  Rig rig = under_way();
  rig.take(tightening(rig, 2, {.max_depth = Meters{100}}));
  for (int i = 0; i < 30 && rig.state() == MissionState::kSearch; ++i) {
    rig.depth = Meters{330};  // beyond 320
    const Time measured = rig.now + Duration::seconds(1);
    rig.step({.navigation = rig.navigation_at(measured), .snr = messages::SnrMeasurement{.time = measured, .snr = rig.snr}});
  }
  EXPECT_EQ(rig.state(), MissionState::kAbort);
}

TEST(Tightened, EndsAMissionWhoseNewTimeIsOver) {
  Rig rig = under_way();
  rig.take(tightening(rig, 2, {.max_time_s = 5.0}));
  rig.sail();
  EXPECT_EQ(rig.end_reason(), EndReason::kTimeUsedUp);
}

TEST(Tightened, IsNeverLooserThanTheLastTime) {
  Rig rig = under_way();
  rig.take(tightening(rig, 2, {.max_depth = Meters{100}}));
  rig.sail();
  rig.take(tightening(rig, 3, {.max_depth = Meters{101}}));
  rig.sail();
  EXPECT_EQ(outcome_of(rig.outputs), CommandOutcome::kNotTighter);
  EXPECT_EQ(rig.outputs.setpoint->depth.value, 300.0 * 100.0 / 320.0);
}

TEST(Tightened, IsNotAskedOfAMissionThatIsOver) {
  Rig rig = under_way();
  rig.sail(Order::kAbort);
  rig.take(tightening(rig, 9, {.max_depth = Meters{100}}));
  rig.sail();
  EXPECT_EQ(outcome_of(rig.outputs), CommandOutcome::kNotInThisState);
}

TEST(Verified, MustBeEveryOrderButAnAbortWhereTheMissionNamesAKey) {
  config::Mission mission = paper_mission();
  mission.authority.needs_verified_commands = true;
  Rig rig(*policy_that_goes(kNorthward), mission);
  rig.sail(Order::kStart);
  EXPECT_EQ(outcome_of(rig.outputs), CommandOutcome::kNotVerified);
  EXPECT_EQ(rig.state(), MissionState::kStandby);
  messages::OperatorCommand start = command_of(Order::kStart, rig.now, 1);
  start.is_verified = true;
  rig.take(start);
  rig.sail();
  EXPECT_EQ(outcome_of(rig.outputs), CommandOutcome::kObeyed) << "the refused one did not use its number up";
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  rig.give(Order::kPause);
  rig.sail();
  EXPECT_EQ(outcome_of(rig.outputs), CommandOutcome::kNotVerified);
  rig.sail(Order::kAbort);
  EXPECT_EQ(rig.state(), MissionState::kAbort);
}

TEST(Disconnected, IsAMissionWhoseAutopilotIsNotHeardAndItsStartWaits) {
  config::Mission mission = paper_mission();
  mission.authority.autopilot_timeout = Duration::seconds(3);
  Rig rig(*policy_that_goes(kNorthward), mission);
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.outputs.health.authority, Authority::kDisconnected);
  EXPECT_EQ(rig.state(), MissionState::kStandby);
  rig.take(messages::AutopilotStatus{.time = rig.now, .follows_setpoints = false});
  rig.sail();
  EXPECT_EQ(rig.outputs.health.authority, Authority::kCommand);
  for (int i = 0; i < 10; ++i) rig.sail();
  EXPECT_EQ(rig.outputs.health.authority, Authority::kCommand) << "a rule says what is to be done when it falls silent";
}

TEST(Heartbeat, CountsTurnsAndDecisions) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.sail();
  EXPECT_EQ(rig.outputs.health.turn, 1U);
  EXPECT_EQ(rig.outputs.health.decisions, 0U);
  EXPECT_EQ(rig.outputs.health.authority, Authority::kStandby);
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.outputs.health.turn, 2U);
  EXPECT_EQ(rig.outputs.health.decisions, 1U);
  rig.sail_to_decision();
  EXPECT_EQ(rig.outputs.health.decisions, 2U);
}

}  // namespace
}  // namespace earshot::runtime
