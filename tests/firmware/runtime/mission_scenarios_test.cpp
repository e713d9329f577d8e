#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

// Whole missions, as a vehicle may meet them: GIVEN a search under way, WHEN something happens, THEN it ends as it should.

void expect_surfacing(const Rig& rig) {
  EXPECT_EQ(rig.setpoint.speed, MetersPerSecond{0});
  EXPECT_EQ(rig.setpoint.depth, Meters{0});
  EXPECT_EQ(rig.setpoint.heading, rig.heading);
}

Rig given_a_search_under_way(std::size_t action = kNorthward) {
  Rig rig(*policy_that_goes(action));
  rig.sail(Order::kStart);
  for (int i = 0; i < 100; ++i) rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  return rig;
}

TEST(Mission, EndsDoneWhenTheOperatorSaysTheSourceIsReached) {
  Rig rig = given_a_search_under_way();
  rig.sail(Order::kComplete);
  EXPECT_EQ(rig.state(), MissionState::kDone);
  EXPECT_EQ(rig.end_reason(), EndReason::kCompleted);
  EXPECT_EQ(rig.outputs.health.steps_taken, 1U) << "the step under way counts";
  expect_surfacing(rig);
}

TEST(Mission, EndsDoneWhenItsStepsAreUsedUpAndNotOneEarlier) {
  config::Mission mission = paper_mission();
  mission.max_steps = 3;
  Rig rig(*policy_that_goes(kNorthward), mission);
  rig.sail(Order::kStart);
  rig.sail_to_decision();
  rig.sail_to_decision();
  EXPECT_EQ(rig.outputs.health.steps_taken, 2U);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  rig.sail_to_decision();
  EXPECT_EQ(rig.outputs.health.steps_taken, 3U);
  EXPECT_EQ(rig.state(), MissionState::kDone);
  EXPECT_EQ(rig.end_reason(), EndReason::kStepsUsedUp);
  EXPECT_FALSE(rig.outputs.decision);
  expect_surfacing(rig);
}

TEST(Mission, AbortsWhenTheOperatorSaysSoWhateverItIsDoing) {
  for (const bool started : {false, true}) {
    Rig rig(*policy_that_goes(kNorthward));
    rig.sail(started ? std::optional(Order::kStart) : std::nullopt);
    rig.sail(Order::kAbort);
    EXPECT_EQ(rig.state(), MissionState::kAbort);
    EXPECT_EQ(rig.end_reason(), EndReason::kOperatorAbort);
    if (started) expect_surfacing(rig);
  }
}

TEST(Mission, AbortsHoweverManyOtherOrdersAreTakenBesideTheAbort) {
  using enum Order;
  for (const Order other : {kStart, kComplete}) {
    Rig rig(*policy_that_goes(kNorthward));
    rig.sail();
    for (const Order order : {kStart, kAbort, other}) rig.give(order);
    rig.sail();
    EXPECT_EQ(rig.state(), MissionState::kAbort);
    EXPECT_EQ(rig.end_reason(), EndReason::kOperatorAbort);
    EXPECT_EQ(rig.counters().commands_refused, 1U);
  }
}

TEST(Mission, GoesOnWithAGoodFixThoughABadOneIsTakenAfterItInEveryTurn) {
  Rig rig = given_a_search_under_way();
  for (int second = 1; second <= 20; ++second) {
    const Time now = rig.now + Duration::seconds(1);
    rig.move();
    rig.take(rig.navigation_at(rig.now));
    messages::Navigation bad = rig.navigation_at(now);
    bad.position.north = Meters{std::nan("")};
    rig.step({.navigation = bad, .snr = messages::SnrMeasurement{.time = now, .snr = rig.snr}});
    ASSERT_EQ(rig.state(), MissionState::kSearch) << second;
  }
  EXPECT_EQ(rig.counters().navigation_refused, 20U);
}

TEST(Mission, AbortsOnceNavigationIsOlderThanItsTimeoutAndNotBefore) {
  Rig rig = given_a_search_under_way();
  const auto step_without_navigation = [&rig] { rig.step({.snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}}); };
  for (int second = 1; second <= 5; ++second) step_without_navigation();
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  step_without_navigation();
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kNavigationStale);
  expect_surfacing(rig);
}

TEST(Mission, AbortsWhenNavigationGoesOnSayingNothingButNan) {
  Rig rig = given_a_search_under_way();
  rig.position.north = Meters{std::nan("")};
  for (int second = 1; second <= 6; ++second) {
    rig.step({.navigation = rig.navigation_at(rig.now + Duration::seconds(1)),
              .snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}});
  }
  EXPECT_EQ(rig.end_reason(), EndReason::kNavigationStale);
  EXPECT_EQ(rig.counters().navigation_refused, 6U);
}

TEST(Mission, AbortsOnceTheSnrIsOlderThanItsTimeoutAndNotBefore) {
  Rig rig = given_a_search_under_way();
  const auto step_without_snr = [&rig] {
    rig.move();
    rig.step({.navigation = rig.navigation_at(rig.now + Duration::seconds(1))});
  };
  for (int second = 1; second <= 30; ++second) step_without_snr();
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  step_without_snr();
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kSnrStale);
  expect_surfacing(rig);
}

TEST(Mission, AbortsWhenACurrentCarriesItOutOfTheOperatingArea) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.position = at(19990, 12000);
  rig.sail(Order::kStart);
  rig.position = at(20000, 12000);  // on the edge, which still belongs to the area
  rig.step(
      {.navigation = rig.navigation_at(rig.now + Duration::seconds(1)), .snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}});
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  rig.position = at(20000.5, 12000);
  rig.step(
      {.navigation = rig.navigation_at(rig.now + Duration::seconds(1)), .snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}});
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kLeftOperatingArea);
  expect_surfacing(rig);
}

TEST(Mission, AbortsAtOnceWhenStartedOutsideTheOperatingArea) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.position = at(0, 0);  // west of the area
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kLeftOperatingArea);
  EXPECT_FALSE(rig.outputs.decision);
}

TEST(Mission, AbortsWhenItsTimeIsUsedUpAndNotBefore) {
  config::Mission mission = paper_mission();
  mission.max_time = Duration::seconds(700);
  Rig rig(*policy_that_goes(kNorthward), mission);
  rig.sail(Order::kStart);
  for (int second = 1; second <= 700; ++second) rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kTimeUsedUp);
  expect_surfacing(rig);
}

TEST(Mission, ObeysACommandThatItRefusedForItsDateWhenItComesAgainWithAnother) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.take(command_of(Order::kStart, rig.now + Duration::seconds(-3600), 5));
  EXPECT_EQ(rig.sail().health.state, MissionState::kStandby);
  rig.take(command_of(Order::kStart, rig.now, 5));
  EXPECT_EQ(rig.sail().health.state, MissionState::kSearch);
}

TEST(Mission, BeginsOnceThoughItsStartIsRepeatedUntilItIsAcknowledged) {
  Rig rig(*policy_that_goes(kNorthward));
  const messages::OperatorCommand start = command_of(Order::kStart, rig.now, 5);
  for (int second = 0; second < 3; ++second) {
    rig.take(start);
    const Acknowledgements acknowledged = rig.sail().acknowledgements;
    ASSERT_EQ(acknowledged.size(), 1U);
    EXPECT_EQ(acknowledged[0].outcome, messages::CommandOutcome::kObeyed) << second;
  }
  EXPECT_EQ(rig.counters().commands_refused, 0U);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
}

TEST(Mission, CountsStepsOfOneMetreToo) {
  config::Mission mission = paper_mission();
  mission.step_length = Meters{1};
  const auto policy = policy_that_goes(kNorthward);
  policy->step_length = Meters{1};
  Rig rig(*policy, mission);
  rig.sail(Order::kStart);
  for (int second = 0; second < 3; ++second) rig.sail();
  EXPECT_EQ(rig.outputs.health.steps_taken, 3U) << "one a second, at 2 m/s";
}

TEST(Mission, AnswersAnOrderAfterAnAbortByItsStateWhateverNumberTheAbortHad) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.take(command_of(Order::kAbort, rig.now, 100));
  rig.take(command_of(Order::kStart, rig.now, 5));
  const Acknowledgements acknowledged = rig.sail().acknowledgements;
  ASSERT_EQ(acknowledged.size(), 2U);
  EXPECT_EQ(acknowledged[1].outcome, messages::CommandOutcome::kNotInThisState);
}

TEST(Mission, StaysAbortedForTheFirstReasonWhateverComes) {
  Rig rig = given_a_search_under_way();
  for (int second = 1; second <= 40; ++second) rig.step({});
  ASSERT_EQ(rig.end_reason(), EndReason::kNavigationStale);
  for (const Order command : {Order::kStart, Order::kComplete, Order::kAbort}) {
    rig.sail(command);
    EXPECT_EQ(rig.state(), MissionState::kAbort);
    EXPECT_EQ(rig.end_reason(), EndReason::kNavigationStale);
  }
}

TEST(Mission, IsTurnedBackFromTheEdgeByTheSafetyLayerHoweverLongThePolicyPushes) {
  // GIVEN a policy that only ever goes north
  Rig rig(*policy_that_goes(kNorthward));
  rig.sail(Order::kStart);
  std::uint64_t overridden = 0;
  int decisions = 1;
  // WHEN it searches until its steps are used up
  while (rig.sail_to_decision().health.state == MissionState::kSearch) {
    if (rig.outputs.decision->overridden) ++overridden;
    ++decisions;
    // THEN the vehicle keeps its margin (with 2 m of overshoot, one second's way), and
    ASSERT_LE(rig.position.north, Meters{19502});
  }
  // every step is a real one, at least half a step long, and the overrides are counted.
  EXPECT_GT(overridden, 0U);
  EXPECT_EQ(decisions, 100);
  EXPECT_EQ(rig.end_reason(), EndReason::kStepsUsedUp);
  EXPECT_GE(rig.now - Time{1'000'000'000}, Duration::seconds(100 * 250));
  EXPECT_EQ(rig.counters().setpoints_limited, overridden);
}

/// Every field of the outputs, bit by bit.
void append(std::vector<std::uint64_t>& bits, const Outputs& outputs) {
  const auto add = [&bits](double value) { bits.push_back(std::bit_cast<std::uint64_t>(value)); };
  bits.push_back(static_cast<std::uint64_t>(outputs.health.state));
  bits.push_back(static_cast<std::uint64_t>(outputs.health.end_reason));
  bits.push_back(outputs.health.steps_taken);
  const messages::Setpoint setpoint = outputs.setpoint.value_or(messages::Setpoint{});
  add(setpoint.heading.value);
  add(setpoint.speed.value);
  add(setpoint.depth.value);
  add(setpoint.waypoint.north.value);
  add(setpoint.waypoint.east.value);
  if (!outputs.decision) return;
  for (const float value : outputs.decision->observation) bits.push_back(std::bit_cast<std::uint32_t>(value));
  for (const float value : outputs.decision->logits) bits.push_back(std::bit_cast<std::uint32_t>(value));
  bits.push_back(outputs.decision->action);
}

std::vector<std::uint64_t> bits_of_a_whole_mission() {
  std::vector<std::uint64_t> bits;
  Rig rig(*policy_that_wanders());
  rig.sail(Order::kStart);
  do {
    append(bits, rig.sail());
    rig.snr = Decibels{20.0 - rig.position.north.value * 1e-3};
  } while (rig.state() == MissionState::kSearch);
  EXPECT_EQ(rig.end_reason(), EndReason::kStepsUsedUp);
  return bits;
}

TEST(Mission, GivesTheSameBitsWhenFlownTwice) {
  EXPECT_EQ(bits_of_a_whole_mission(), bits_of_a_whole_mission());
}

}  // namespace
}  // namespace earshot::runtime
