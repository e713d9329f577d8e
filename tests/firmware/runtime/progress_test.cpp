#include "firmware/runtime/progress.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

using messages::CommandOutcome;

constexpr Time kBegan{1'000'000'000};

/// The progress of the paper's mission, of a vehicle that hears something where it lies.
struct Underway {
  config::Mission mission;
  Progress progress;
  Time now = kBegan;
  std::uint32_t orders = 0;

  explicit Underway(const config::Mission& flown = paper_mission()) : mission(flown) {
    progress.arm(mission);
    hear_at(at(7000, 12000));
  }

  void hear_at(NorthEast position) {
    const Intake::Arrival arrival{.mission = mission, .state = progress.state(), .time = now, .port = 1};
    progress.intake.take(arrival,
                         messages::Navigation{.time = now, .position = position, .depth = Meters{0}, .heading = Radians{0}, .speed = {}});
    progress.intake.take(arrival, messages::SnrMeasurement{.time = now, .snr = Decibels{3}});
  }

  CommandOutcome give(Order order) { return progress.obey(mission, now, command_of(order, now, ++orders)); }

  /// A search that has decided to go 1 km north.
  void begin(Order order) {
    EXPECT_EQ(give(order), CommandOutcome::kObeyed);
    EXPECT_TRUE(progress.may_begin_search(mission, now));
    progress.begin_search(now);
    progress.decide_anew();
    progress.begin_leg({.waypoint = at(8000, 12000), .overridden = false}, now);
  }

  [[nodiscard]] bool leg_goes_on() const { return progress.leg_goes_on(mission, now); }
};

TEST(Progress, ObeysNothingButAnAbortBeforeItIsArmed) {
  const config::Mission mission = paper_mission();
  Progress progress;
  EXPECT_FALSE(progress.is_armed());
  EXPECT_EQ(progress.obey(mission, kBegan, command_of(Order::kStart, kBegan)), CommandOutcome::kNotConfigured);
  EXPECT_EQ(progress.obey(mission, kBegan, command_of(Order::kAbort, kBegan)), CommandOutcome::kObeyed);
  EXPECT_EQ(progress.state(), MissionState::kAbort);
  EXPECT_EQ(progress.end_reason(), EndReason::kOperatorAbort);
}

TEST(Progress, BeginsNoSearchUnlessItIsOrderedAndWhatItNeedsIsFresh) {
  Underway underway;
  EXPECT_FALSE(underway.progress.may_begin_search(underway.mission, kBegan)) << "nobody ordered it";
  ASSERT_EQ(underway.give(Order::kStart), CommandOutcome::kObeyed);
  EXPECT_TRUE(underway.progress.may_begin_search(underway.mission, kBegan));
  EXPECT_FALSE(underway.progress.may_begin_search(underway.mission, kBegan + Duration::seconds(6))) << "the fix is 6 s old";
  underway.mission.authority.autopilot_timeout = Duration::seconds(10);
  EXPECT_FALSE(underway.progress.may_begin_search(underway.mission, kBegan)) << "no autopilot";
}

TEST(Progress, IsEngagedByAStartAndNotByAListen) {
  for (const Order order : {Order::kStart, Order::kListen}) {
    Underway underway;
    underway.begin(order);
    EXPECT_EQ(underway.progress.is_engaged(), order == Order::kStart);
    EXPECT_EQ(underway.progress.setpoint(underway.mission, underway.now).has_value(), order == Order::kStart);
  }
}

TEST(Progress, SailsALegUntilItsEndIsReachedHoweverLongThatTakes) {
  Underway underway;
  underway.begin(Order::kStart);
  underway.now = kBegan + Duration::seconds(3600);
  EXPECT_TRUE(underway.leg_goes_on());
  underway.hear_at(at(8000, 12000));
  EXPECT_FALSE(underway.leg_goes_on());
}

/// 1 km at 2 m/s.
TEST(Progress, ListensOverALegForAsLongAsItWouldTake) {
  Underway underway;
  underway.begin(Order::kListen);
  underway.now = kBegan + Duration::seconds(kLeg_s - 1);
  EXPECT_TRUE(underway.leg_goes_on());
  underway.now = kBegan + Duration::seconds(kLeg_s);
  EXPECT_FALSE(underway.leg_goes_on());
}

TEST(Progress, GoesOnWithNoLegThatWasInterrupted) {
  Underway underway;
  underway.begin(Order::kStart);
  EXPECT_TRUE(underway.leg_goes_on());
  underway.progress.interrupt();
  EXPECT_FALSE(underway.leg_goes_on());
}

TEST(Progress, InterruptsTheLegOfAListenerThatIsToldToStart) {
  Underway underway;
  underway.begin(Order::kListen);
  EXPECT_EQ(underway.give(Order::kListen), CommandOutcome::kNotInThisState);
  EXPECT_TRUE(underway.leg_goes_on()) << "nothing became of that order";
  EXPECT_EQ(underway.give(Order::kStart), CommandOutcome::kObeyed);
  EXPECT_FALSE(underway.leg_goes_on());
}

TEST(Progress, HoldsWhilePausedAndWantsNothingOtherwise) {
  Underway underway;
  underway.begin(Order::kStart);
  EXPECT_FALSE(underway.progress.response());
  EXPECT_EQ(underway.give(Order::kPause), CommandOutcome::kObeyed);
  EXPECT_EQ(underway.progress.response(), config::Response::kHold);
  EXPECT_EQ(underway.give(Order::kResume), CommandOutcome::kObeyed);
  EXPECT_FALSE(underway.progress.response());
}

TEST(Progress, HoldsWhereItIsPausedAgainAndNotWhereItWasBefore) {
  Underway underway;
  underway.begin(Order::kStart);
  underway.progress.intake.note_time(underway.now);
  (void)underway.give(Order::kPause);
  EXPECT_EQ(underway.progress.setpoint(underway.mission, underway.now)->waypoint, at(7000, 12000));
  (void)underway.give(Order::kResume);
  underway.progress.decide_anew();
  underway.now = kBegan + Duration::seconds(300);
  underway.hear_at(at(7500, 12000));
  underway.progress.intake.note_time(underway.now);
  (void)underway.give(Order::kPause);
  EXPECT_EQ(underway.progress.setpoint(underway.mission, underway.now)->waypoint, at(7500, 12000));
}

TEST(Progress, WatchesWhatReleasesTheWeightWhenItIsOver) {
  config::Mission mission = paper_mission();
  ASSERT_EQ(mission.safety.rules.push_back({.condition = config::Condition::kLeak,
                                            .limit = 0,
                                            .persistence = {},
                                            .response = config::Response::kRelease,
                                            .is_latched = true}),
            Status::kOk);
  Underway underway(mission);
  underway.begin(Order::kStart);
  (void)underway.give(Order::kAbort);
  underway.progress.intake.take({.mission = mission, .state = underway.progress.state(), .time = kBegan, .port = 1},
                                messages::VehicleStatus{.time = kBegan, .has_leak = true});
  safety::SafetyEvents events;
  underway.progress.watch_for_release(mission, kBegan, events);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].condition, config::Condition::kLeak);
  EXPECT_EQ(underway.progress.response(), config::Response::kRelease);
}

TEST(Progress, EndsWithTheReasonOfTheRuleThatEndsIt) {
  Underway underway;
  underway.begin(Order::kStart);
  safety::SafetyEvents events;
  underway.progress.supervise(underway.mission, kBegan + Duration::seconds(1), events);
  EXPECT_EQ(underway.progress.state(), MissionState::kSearch);
  underway.progress.supervise(underway.mission, kBegan + Duration::seconds(6), events);
  EXPECT_EQ(underway.progress.state(), MissionState::kAbort);
  EXPECT_EQ(underway.progress.end_reason(), EndReason::kNavigationStale);
}

TEST(Progress, CountsTheStepUnderWayWhenTheOperatorSaysThatTheSourceIsReached) {
  Underway underway;
  EXPECT_EQ(underway.give(Order::kComplete), CommandOutcome::kNotInThisState);
  underway.begin(Order::kStart);
  EXPECT_EQ(underway.give(Order::kComplete), CommandOutcome::kObeyed);
  const messages::Health health = underway.progress.health(underway.mission, underway.now);
  EXPECT_EQ(health.state, MissionState::kDone);
  EXPECT_EQ(health.end_reason, EndReason::kCompleted);
  EXPECT_EQ(health.steps_taken, 1U);
  EXPECT_EQ(health.decisions, 1U);
}

TEST(Progress, CommandsNoDepthBelowTheLimitThoughTheMissionSearchesThere) {
  Underway underway;
  underway.begin(Order::kStart);
  underway.mission.max_depth = Meters{200};  // it searches at 300 m, which config::check would refuse
  const std::optional<messages::Setpoint> setpoint = underway.progress.setpoint(underway.mission, underway.now);
  ASSERT_TRUE(setpoint);
  EXPECT_EQ(setpoint->depth, Meters{200});
  EXPECT_EQ(underway.progress.health(underway.mission, underway.now).counters.setpoints_limited, 1U);
  EXPECT_EQ(underway.progress.intake.situation().commanded->depth, Meters{200}) << "what leaves, and not what was wanted";
}

TEST(Progress, CountsWhatTheSafetyLayerChangedAndTellsItBesideWhatWasRefused) {
  Underway underway;
  underway.begin(Order::kStart);
  underway.progress.begin_leg({.waypoint = at(8000, 12500), .overridden = true}, underway.now);
  underway.progress.orders.answer({.time = kBegan, .port = 1, .command = command_of(Order::kPause, kBegan)}, {},
                                  CommandOutcome::kNotInThisState);
  const messages::Counters counters = underway.progress.health(underway.mission, underway.now).counters;
  EXPECT_EQ(counters.setpoints_limited, 1U);
  EXPECT_EQ(counters.commands_refused, 1U);
  EXPECT_EQ(counters.navigation_refused, 0U);
}

}  // namespace
}  // namespace earshot::runtime
