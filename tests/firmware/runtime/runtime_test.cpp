#include "firmware/runtime/runtime.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "tests/firmware/not_finite.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

using tests::kNan;
constexpr double kHalfPi = 1.57079632679489661923;

/// A rig whose search has begun and taken its first decision.
Rig searching(std::size_t action = kNorthward) {
  Rig rig(*policy_that_goes(action));
  rig.sail(Order::kStart);
  return rig;
}

TEST(Runtime, RefusesToStartBeforeItIsConfigured) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.runtime = std::make_unique<Runtime>();
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.sail().health.state, MissionState::kStandby);
  EXPECT_EQ(rig.counters().commands_refused, 1U);
}

TEST(Runtime, CommandsNothingUntilItIsStarted) {
  Rig rig(*policy_that_goes(kNorthward));
  for (int i = 0; i < 100; ++i) {
    rig.sail();
    ASSERT_EQ(rig.state(), MissionState::kStandby);
    ASSERT_FALSE(rig.outputs.setpoint) << "until the search begins the autopilot is not ours";
    ASSERT_FALSE(rig.outputs.decision);
  }
}

TEST(Runtime, RemembersTheStartUntilNavigationAndSnrAreThere) {
  Rig rig(*policy_that_goes(kNorthward));
  EXPECT_EQ(rig.step({.order = Order::kStart}).health.state, MissionState::kStandby);
  EXPECT_EQ(rig.step({.navigation = rig.navigation_at(rig.now)}).health.state, MissionState::kStandby);
  EXPECT_EQ(rig.step({.snr = messages::SnrMeasurement{.time = rig.now, .snr = Decibels{0}}}).health.state, MissionState::kSearch);
}

TEST(Runtime, DoesNotStartOnNavigationThatIsStale) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.step({.navigation = rig.navigation_at(rig.now)});
  for (int i = 0; i < 6; ++i) rig.step({.snr = messages::SnrMeasurement{.time = rig.now, .snr = Decibels{0}}});
  EXPECT_EQ(rig.step({.order = Order::kStart}).health.state, MissionState::kStandby);
  EXPECT_EQ(rig.sail().health.state, MissionState::kSearch);
}

TEST(Runtime, DecidesAtOnceWhenTheSearchBegins) {
  Rig rig(*policy_that_goes(kEastward));
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  ASSERT_TRUE(rig.outputs.decision);
  const messages::Decision& decision = *rig.outputs.decision;
  EXPECT_EQ(decision.step, 0U);
  EXPECT_EQ(decision.time, rig.now);
  EXPECT_EQ(decision.position, at(7000, 12000));
  EXPECT_EQ(decision.waypoint, at(7000, 13000));
  EXPECT_EQ(decision.action, kEastward);
  EXPECT_EQ(decision.snr, Decibels{12});
  EXPECT_TRUE(decision.detected);
  EXPECT_FALSE(decision.overridden);
  EXPECT_EQ(decision.observation_size, 2);
  EXPECT_EQ(decision.action_count, 4);
  EXPECT_EQ(decision.logits[kEastward], 1.0F);
}

TEST(Runtime, ObservesThePlaceRelativeToTheSouthWestCornerOfTheArea) {
  const Rig rig = searching();
  // (7000, 12000) lies 12 km north and 11 km east of (-5000, 1000); 12.5 km is the middle.
  EXPECT_NEAR(rig.outputs.decision->observation[0], -1.5 / 12.5, 1e-7);  // rounding of the scale to a float
  EXPECT_NEAR(rig.outputs.decision->observation[1], -0.5 / 12.5, 1e-7);
}

TEST(Runtime, CommandsHeadingSpeedDepthAndWaypointOfTheLeg) {
  const Rig rig = searching(kEastward);
  EXPECT_NEAR(rig.setpoint.heading.value, kHalfPi, 1e-15);
  EXPECT_EQ(rig.setpoint.speed, MetersPerSecond{2});
  EXPECT_EQ(rig.setpoint.depth, Meters{300});
  EXPECT_EQ(rig.setpoint.waypoint, at(7000, 13000));
}

TEST(Runtime, DecidesAgainAfterOneStepLength) {
  Rig rig = searching();
  const Time began = rig.now;
  rig.snr = Decibels{9};
  rig.sail_to_decision();
  EXPECT_EQ(rig.outputs.health.steps_taken, 1U);
  EXPECT_EQ(rig.outputs.decision->step, 1U);
  EXPECT_EQ(rig.now - began, Duration::seconds(500));  // 1000 m at 2 m/s
  EXPECT_EQ(rig.outputs.decision->position, at(8000, 12000));
  EXPECT_FALSE(rig.outputs.decision->detected);
}

TEST(Runtime, RemembersStepsAndSnrForAMemoryPolicy) {
  const auto policy = policy_that_goes(kWestward);
  policy->observation.spec = policy::memory_state(2, Meters{1000}, Decibels{10}).value();
  tests::set_inputs(policy->network, 6);
  Rig rig(*policy);
  rig.snr = Decibels{40};
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.outputs.decision->observation[2], 1.0F);  // (40 - 10) / 30
  rig.snr = Decibels{-20};
  rig.sail_to_decision();
  EXPECT_NEAR(rig.outputs.decision->observation[0], -1.0F, 1e-6F);  // one step west; 500 steps of 2 m add up to 1000 m within rounding
  EXPECT_NEAR(rig.outputs.decision->observation[1], 0.0F, 1e-6F);
  EXPECT_EQ(rig.outputs.decision->observation[2], -1.0F);
  EXPECT_EQ(rig.outputs.decision->observation[5], 1.0F);
}

TEST(Runtime, TellsWithItsDecisionWhereItBelievesTheSource) {
  const auto tables = one_ocean();
  Rig rig(*policy_that_believes(), paper_mission(), *tables);
  rig.snr = Decibels{20};
  rig.sail(Order::kStart);
  ASSERT_TRUE(rig.outputs.decision->belief);
  // The likeliest place lies on the circle of 30 times 393.7 m about the vehicle, in the mission's frame; a cell is 500 m across.
  EXPECT_NEAR(range_between(rig.outputs.decision->belief->likeliest, rig.position).value, 11'811.0, 500.0);
  const auto memory = std::make_unique<policy::SearchMemory>();  // the same measurement, 12 km north and 11 km east of the area's corner
  memory->start(policy_that_believes()->observation, *tables, at(12'000, 11'000), {.snr = Decibels{20}});
  EXPECT_EQ(rig.outputs.decision->belief->likeliest, memory->belief().summary().likeliest + at(-5'000, 1'000));
  EXPECT_EQ(rig.outputs.decision->belief->mean, memory->belief().summary().mean + at(-5'000, 1'000));
  EXPECT_EQ(rig.outputs.decision->belief->spread, memory->belief().summary().spread);
  EXPECT_FALSE(Rig(*policy_that_goes(kNorthward)).sail(Order::kStart).decision->belief) << "a policy that sees none holds none";
}

/// On its way it refines its hypotheses, a slice a turn; nothing that it believes depends on when.
TEST(Runtime, BelievesWhatASearchDoesThatRefinesBeforeEveryMeasurement) {
  const auto tables = paper_oceans();
  Rig rig(*policy_that_believes(), paper_mission(), *tables);
  const auto memory = std::make_unique<policy::SearchMemory>();
  const policy::ObservationModel model = policy_that_believes()->observation;
  for (int step = 0; step < 5; ++step) {
    rig.snr = Decibels{20.0 + step};
    step == 0 ? rig.sail(Order::kStart) : rig.sail_to_decision();
    const NorthEast place = rig.position - at(-5'000, 1'000);
    step == 0 ? memory->start(model, *tables, place, {.snr = rig.snr}) : memory->remember(model, *tables, place, {.snr = rig.snr});
    ASSERT_TRUE(rig.outputs.decision);
    EXPECT_EQ(rig.outputs.decision->belief->mean, memory->belief().summary().mean + at(-5'000, 1'000)) << step;
    EXPECT_EQ(rig.outputs.decision->belief->mismatch_bits, memory->belief().summary().mismatch_bits) << step;
  }
}

TEST(Runtime, TakesASignalTooFaintToMeasureForNoDetectionAndASourceFurtherAway) {
  Rig rig(*policy_that_believes(), paper_mission(), *one_ocean());
  const Time now = rig.now + Duration::seconds(1);
  rig.step({.navigation = rig.navigation_at(now),
            .snr = messages::SnrMeasurement{.time = now, .snr = Decibels{22}, .too_faint = true},
            .order = Order::kStart});
  EXPECT_TRUE(rig.outputs.decision->too_faint);
  EXPECT_FALSE(rig.outputs.decision->detected);
  EXPECT_GT(range_between(rig.outputs.decision->belief->likeliest, rig.position).value, 11'024.0);  // 22 dB are heard at 28 times 393.7 m
}

TEST(Runtime, GoesByItsBeliefsOwnAdviceWhereThePolicyHasNoNetwork) {
  Rig rig(*policy_that_advises(), paper_mission(), *one_ocean());
  rig.snr = Decibels{30};             // from 50 dB down to 30, 20 times 393.7 m: the source is 7.9 km away
  rig.position = at(19'000, 13'500);  // 1 km from the north edge
  rig.sail(Order::kStart);
  ASSERT_TRUE(rig.outputs.decision);
  const messages::Decision& decision = *rig.outputs.decision;
  EXPECT_EQ(decision.action, kSouthward);
  const policy::ObservationSpec spec = policy_that_advises()->observation.spec;
  for (std::size_t i = 0; i < spec.size(); ++i) {
    if (spec[i].feature == policy::Feature::kPreference) {
      EXPECT_EQ(decision.logits[spec[i].age], decision.observation[i]) << i;
    }
  }
  EXPECT_EQ(decision.logits[kSouthward], 1.0F) << "no regret";
  EXPECT_LT(decision.logits[kNorthward], 1.0F);
}

TEST(Runtime, EndsTheSearchThatBeginsBeyondAnyOcean) {
  Rig rig(*policy_that_believes());
  rig.position = at(1.9e6, -1.9e6);
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kLeftOperatingArea);
  EXPECT_FALSE(rig.outputs.decision);
}

TEST(Runtime, RefusesNavigationThatIsNotFiniteAndKeepsTheLast) {
  Rig rig = searching();
  const messages::Setpoint before = rig.setpoint;
  for (int field = 0; field < 5; ++field) {
    messages::Navigation bad = rig.navigation_at(rig.now);
    if (field == 0) bad.position.north = Meters{kNan};
    if (field == 1) bad.position.east = Meters{kNan};
    if (field == 2) bad.depth = Meters{kNan};
    if (field == 3) bad.heading = Radians{kNan};
    if (field == 4) bad.speed = MetersPerSecond{std::numeric_limits<double>::infinity()};
    rig.step_again({.navigation = bad});
  }
  EXPECT_EQ(rig.counters().navigation_refused, 5U);
  EXPECT_EQ(rig.setpoint, before);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
}

TEST(Runtime, TakesAFixWhoseSpeedNobodyKnows) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.position = at(19999, 12000);
  rig.sail(Order::kStart);
  messages::Navigation fix = rig.navigation_at(rig.now);
  fix.position = at(20001, 12000);  // where a search ends
  fix.speed = messages::kUnknownSpeed;
  rig.step_again({.navigation = fix});
  EXPECT_EQ(rig.counters().navigation_refused, 0U);
  EXPECT_EQ(rig.end_reason(), EndReason::kLeftOperatingArea);
}

TEST(Runtime, RefusesAnSnrThatNoOceanHas) {
  Rig rig = searching();
  for (const double bad : {kNan, std::numeric_limits<double>::infinity(), 601.0, -601.0}) {
    rig.step({.navigation = rig.navigation_at(rig.now), .snr = messages::SnrMeasurement{.time = rig.now, .snr = Decibels{bad}}});
  }
  EXPECT_EQ(rig.counters().snr_refused, 4U);
  rig.step({.navigation = rig.navigation_at(rig.now), .snr = messages::SnrMeasurement{.time = rig.now, .snr = Decibels{-600.0}}});
  EXPECT_EQ(rig.counters().snr_refused, 4U) << "no source of 0 dB under noise of 300 dB, 300 dB away, is fainter";
}

TEST(Runtime, RefusesWhatIsOlderThanTheLastButTakesItAgain) {
  Rig rig = searching();
  const Time last = rig.now;
  rig.step({.navigation = rig.navigation_at(last), .snr = messages::SnrMeasurement{.time = last, .snr = Decibels{3}}});
  EXPECT_EQ(rig.counters().navigation_refused, 0U);
  EXPECT_EQ(rig.counters().snr_refused, 0U);
  const Time earlier{last.us - 1};
  rig.step({.navigation = rig.navigation_at(earlier), .snr = messages::SnrMeasurement{.time = earlier, .snr = Decibels{3}}});
  EXPECT_EQ(rig.counters().navigation_refused, 1U);
  EXPECT_EQ(rig.counters().snr_refused, 1U);
}

TEST(Runtime, RefusesTimesNegativeOrFromFurtherAheadThanTheTimeout) {
  Rig rig(*policy_that_goes(kNorthward));
  for (const Time wrong : {Time{-1}, Time{std::numeric_limits<std::int64_t>::min()}, Time{std::numeric_limits<std::int64_t>::max()},
                           rig.now + Duration::seconds(37)}) {
    rig.step({.navigation = rig.navigation_at(wrong), .snr = messages::SnrMeasurement{.time = wrong, .snr = Decibels{3}}});
  }
  EXPECT_EQ(rig.counters().navigation_refused, 4U);
  EXPECT_EQ(rig.counters().snr_refused, 4U);
}

TEST(Runtime, CountsCommandsThatItsStateDoesNotAllow) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.sail(Order::kComplete);
  EXPECT_EQ(rig.counters().commands_refused, 1U);
  rig.sail(Order::kStart);
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.counters().commands_refused, 2U);
  rig.sail(static_cast<Order>(99));
  EXPECT_EQ(rig.counters().commands_refused, 3U);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
}

TEST(Runtime, AcknowledgesEveryCommandToThePortItCameBy) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.runtime->take({.arrival = rig.now, .port = 3, .sequence = 0, .value = command_of(Order::kComplete, rig.now, 41)});
  rig.runtime->take({.arrival = rig.now, .port = 2, .sequence = 1, .value = command_of(Order::kStart, rig.now, 42)});
  const Acknowledgements acknowledged = rig.sail().acknowledgements;
  ASSERT_EQ(acknowledged.size(), 2U);
  EXPECT_EQ(acknowledged[0].port, 3);
  EXPECT_EQ(acknowledged[0].number, 41U);
  EXPECT_EQ(acknowledged[0].outcome, messages::CommandOutcome::kNotInThisState);
  EXPECT_EQ(acknowledged[1].port, 2);
  EXPECT_EQ(acknowledged[1].outcome, messages::CommandOutcome::kObeyed);
  EXPECT_TRUE(rig.sail().acknowledgements.empty()) << "once each";
}

TEST(Runtime, DoesNotStartOnACommandOutOfAnOldRecording) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.take(command_of(Order::kStart, rig.now + Duration::seconds(-3600)));
  rig.sail();
  EXPECT_EQ(rig.sail().health.state, MissionState::kStandby);
  EXPECT_EQ(rig.counters().commands_refused, 1U);
}

TEST(Runtime, RefusesAStreamWhoseDatesAreOldHoweverSteadilyItRunsOn) {
  Rig rig(*policy_that_goes(kNorthward));
  for (int second = 0; second < 100; ++second) {
    const Time old = rig.now + Duration::seconds(-3600);
    rig.step(
        {.navigation = rig.navigation_at(old), .snr = messages::SnrMeasurement{.time = old, .snr = Decibels{12}}, .order = Order::kStart});
  }
  EXPECT_EQ(rig.state(), MissionState::kStandby);
  EXPECT_EQ(rig.counters().navigation_refused, 100U);
  EXPECT_EQ(rig.counters().snr_refused, 100U);
}

TEST(Runtime, ForgetsAStartThatExpiresBeforeNavigationAndSnrCome) {
  Rig rig(*policy_that_goes(kNorthward));
  messages::OperatorCommand start = command_of(Order::kStart, rig.now);
  start.expiry = rig.now + Duration::seconds(10);
  rig.take(start);
  rig.now = rig.now + Duration::seconds(10);
  EXPECT_EQ(rig.sail().health.state, MissionState::kStandby);
}

TEST(Runtime, CommandsNothingWhenAbortedBeforeASearchBegan) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.sail(Order::kAbort);
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_FALSE(rig.outputs.setpoint) << "the autopilot was never ours";
}

TEST(Runtime, TakesNoFixFromASenderWhoseClockIsFast) {
  Rig rig = searching();
  for (int second = 0; second < 60; ++second) {
    if (second % 2 == 0) rig.take(rig.navigation_at(rig.now + Duration::milliseconds(2300)));
    rig.sail();
  }
  EXPECT_EQ(rig.counters().navigation_refused, 30U);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
}

TEST(Runtime, DoesNotTakeADateAheadForLongerFreshness) {
  Rig rig = searching();
  rig.take(rig.navigation_at(rig.now + Duration::milliseconds(500)));
  rig.now = rig.now + Duration::milliseconds(4200);  // and a second: 5.2 s after its arrival, 4.7 s after its date
  rig.step({.snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}});
  EXPECT_EQ(rig.end_reason(), EndReason::kNavigationStale);
}

TEST(Runtime, AcknowledgesAnAbortHoweverManyOrdersCameBeforeIt) {
  Rig rig(*policy_that_goes(kNorthward));
  for (int i = 0; i < 20; ++i) rig.give(Order::kStart);
  rig.give(Order::kAbort);
  const Acknowledgements acknowledged = rig.sail().acknowledgements;
  ASSERT_EQ(acknowledged.size(), config::kMaxAcknowledgements);
  EXPECT_EQ(acknowledged[config::kMaxAcknowledgements - 1].order, Order::kAbort);
  EXPECT_EQ(acknowledged[config::kMaxAcknowledgements - 1].outcome, messages::CommandOutcome::kObeyed);
}

TEST(Runtime, LeavesTheLastOfTooManyOrdersWithoutAcknowledgementSoThatItIsAskedAgain) {
  Rig rig(*policy_that_goes(kNorthward));
  for (std::size_t i = 0; i <= config::kMaxAcknowledgements; ++i) rig.give(Order::kStart);
  const Acknowledgements acknowledged = rig.sail().acknowledgements;
  ASSERT_EQ(acknowledged.size(), config::kMaxAcknowledgements);
  EXPECT_EQ(acknowledged[config::kMaxAcknowledgements - 1].number, config::kMaxAcknowledgements);
}

TEST(Runtime, TellsTheNewestReportOfEveryPort) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.take(messages::PortReport{.port = 0, .received = 5});
  rig.take(messages::PortReport{.port = 1, .link_up = false, .lost = 2});
  rig.take(messages::PortReport{.port = 0, .received = 9});
  const messages::Health health = rig.sail().health;
  ASSERT_EQ(health.ports.size(), 2U);
  EXPECT_EQ(health.ports[0], (messages::PortReport{.port = 0, .received = 9}));
  EXPECT_EQ(health.ports[1], (messages::PortReport{.port = 1, .link_up = false, .lost = 2}));
}

TEST(Runtime, DrawsItsActionsFromTheMissionsSeed) {
  const auto actions_of = [](std::uint64_t seed) {
    config::Mission mission = paper_mission();
    mission.action_seed = seed;
    Rig rig(*policy_that_wanders(), mission);
    rig.sail(Order::kStart);
    std::vector<int> actions;
    for (int i = 0; i < 12; ++i) {
      actions.push_back(rig.outputs.decision->action);
      rig.sail_to_decision();
    }
    return actions;
  };
  EXPECT_EQ(actions_of(1), actions_of(1));
  EXPECT_NE(actions_of(1), actions_of(2));
}

}  // namespace
}  // namespace earshot::runtime
