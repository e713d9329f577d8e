#include "firmware/boards/linux/outage/coming_up.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>

#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::board {
namespace {

using messages::CommandOutcome;
using messages::EndReason;
using messages::MissionState;
using messages::Order;

constexpr Time kBegin{1'795'000'000'000'000};

Time after(double s) {
  return kBegin + Duration{static_cast<std::int64_t>(s * 1e6)};
}

host::SafetyRecord in_search() {
  host::SafetyRecord record;
  record.turn = 1234;
  record.state = MissionState::kSearch;
  record.is_engaged = true;
  record.max_depth = Meters{150};
  record.max_speed = MetersPerSecond{1.5};
  record.max_time = Duration::seconds(600);
  record.deepest = Meters{320};
  record.ascent_speed = MetersPerSecond{0.5};
  record.turn_radius = Meters{30};
  return record;
}

messages::Input fix(double s, double heading, double depth = 300.0) {
  return {.arrival = after(s),
          .port = 1,
          .sequence = 0,
          .value = messages::Navigation{
              .time = after(s), .position = at(1, 2), .depth = Meters{depth}, .heading = Radians{heading}, .speed = MetersPerSecond{1}}};
}

config::Mission mission_that_releases_on_a_leak(Duration persistence) {
  config::Mission mission = runtime::paper_mission();
  EXPECT_EQ(mission.safety.rules.push_back(
                {.condition = config::Condition::kLeak, .persistence = persistence, .response = config::Response::kRelease}),
            Status::kOk);
  return mission;
}

TEST(ComingUp, TellsStopAndComeUpAndThatAnOutageEndedTheSearch) {
  ComingUp core(runtime::paper_mission(), in_search());
  const runtime::Outputs outputs = core.step(kBegin);
  ASSERT_TRUE(outputs.setpoint);
  EXPECT_EQ(outputs.setpoint->depth, Meters{0});
  EXPECT_EQ(outputs.setpoint->speed, MetersPerSecond{0.5});
  EXPECT_FALSE(outputs.setpoint->release_weight);
  EXPECT_EQ(outputs.health.state, MissionState::kAbort);
  EXPECT_EQ(outputs.health.end_reason, EndReason::kOutage);
  EXPECT_EQ(outputs.health.authority, messages::Authority::kAbort);
  EXPECT_EQ(outputs.health.turn, 1235U) << "the heartbeat goes on";
  EXPECT_EQ(core.step(after(1)).health.turn, 1236U);
  EXPECT_EQ(core.mission().max_depth, Meters{150}) << "as it was tightened";
}

TEST(ComingUp, GoesRoundForAsLongAsItMayNeedWhateverDepthItIsToldAndThenStops) {
  ComingUp core(runtime::paper_mission(), in_search());
  // 320 m at 0.1 m/s, and 25 m more in the minute that it takes to turn up.
  for (int s = 0; s < 3510; ++s) {
    core.take(fix(s, 1.0, 0.0));
    const runtime::Outputs outputs = core.step(after(s));
    ASSERT_EQ(outputs.setpoint->speed, MetersPerSecond{0.5}) << s;
    EXPECT_NEAR(outputs.setpoint->heading.value, 1.0 + std::acos(0.0), 1e-12) << "a quarter of a turn ahead";
    EXPECT_EQ(outputs.setpoint->waypoint, at(1, 2));
  }
  static_cast<void>(core.step(after(3511)));
  EXPECT_EQ(core.step(after(3512)).setpoint->speed, MetersPerSecond{0});
}

// Held at 20 m, and its depth says so.
TEST(ComingUp, TriesAgainWhereItsDepthSaysThatItIsBelow) {
  ComingUp core(runtime::paper_mission(), in_search());
  int stopped = 0;
  bool goes_at_last = false;
  for (int s = 0; s < 20'000; ++s) {
    core.take(fix(s, 1.0, 20.0));
    const bool goes = core.step(after(s)).setpoint->speed > MetersPerSecond{0};
    stopped += goes ? 0 : 1;
    goes_at_last = goes_at_last || (goes && stopped > 6000);
  }
  EXPECT_NEAR(stopped, (20'000 - 3510) * 5 / 6, 1000);
  EXPECT_TRUE(goes_at_last);
}

TEST(ComingUp, TurnsWithTheTimeWhileNoHeadingIsTold) {
  ComingUp core(runtime::paper_mission(), in_search());
  // At 0.5 m/s round a circle of 60 m radius a turn takes 754 s; in each eighth of it the heading is another.
  std::set<int> eighths;
  for (int s = 0; s < 754; s += 10)
    eighths.insert(static_cast<int>(std::floor(core.step(after(s)).setpoint->heading.value / std::acos(0.0) * 2)));
  EXPECT_GE(eighths.size(), 8U);
}

TEST(ComingUp, OfAVehicleThatFloatsUpSaysNoSpeed) {
  host::SafetyRecord record = in_search();
  record.ascent_speed = MetersPerSecond{0};
  ComingUp core(runtime::paper_mission(), record);
  EXPECT_EQ(core.step(kBegin).setpoint->speed, MetersPerSecond{0});
}

TEST(ComingUp, KeepsAReleasedWeightReleasedAndTheReasonOfAMissionThatWasOver) {
  host::SafetyRecord record = in_search();
  record.state = MissionState::kAbort;
  record.end_reason = EndReason::kSafetyRule;
  record.is_released = true;
  ComingUp core(runtime::paper_mission(), record);
  const runtime::Outputs outputs = core.step(kBegin);
  EXPECT_TRUE(outputs.setpoint->release_weight);
  EXPECT_EQ(outputs.health.end_reason, EndReason::kSafetyRule);
}

TEST(ComingUp, ReleasesTheWeightOnALeakWhereTheMissionDoes) {
  const messages::Input leak{
      .arrival = kBegin, .port = 1, .sequence = 0, .value = messages::VehicleStatus{.time = kBegin, .has_leak = true}};
  ComingUp without(runtime::paper_mission(), in_search());
  without.take(leak);
  EXPECT_FALSE(without.step(kBegin).setpoint->release_weight);
  ComingUp with(mission_that_releases_on_a_leak({}), in_search());
  with.take(leak);
  EXPECT_TRUE(with.step(kBegin).setpoint->release_weight);
  EXPECT_TRUE(with.step(after(100)).setpoint->release_weight);
}

TEST(ComingUp, ReleasesTheWeightNoSoonerThanTheMissionsRuleDoes) {
  ComingUp core(mission_that_releases_on_a_leak(Duration::seconds(5)), in_search());
  const auto report_leak = [&](double s, bool has_leak) {
    core.take({.arrival = after(s), .port = 1, .sequence = 0, .value = messages::VehicleStatus{.time = after(s), .has_leak = has_leak}});
  };
  report_leak(0, true);
  EXPECT_FALSE(core.step(after(4)).setpoint->release_weight);
  report_leak(4.5, false);
  EXPECT_FALSE(core.step(after(6)).setpoint->release_weight) << "a drop on the sensor";
  report_leak(7, true);
  EXPECT_FALSE(core.step(after(11)).setpoint->release_weight);
  EXPECT_TRUE(core.step(after(12)).setpoint->release_weight);
  report_leak(13, false);
  EXPECT_TRUE(core.step(after(14)).setpoint->release_weight);
}

TEST(ComingUp, ReleasesTheWeightThoughASecondSenderSaysThatThereIsNoLeak) {
  ComingUp core(mission_that_releases_on_a_leak(Duration::seconds(2)), in_search());
  bool is_released = false;
  for (int s = 0; s < 10; ++s) {
    for (const bool has_leak : {true, false})
      core.take({.arrival = after(s), .port = 1, .sequence = 0, .value = messages::VehicleStatus{.time = after(s), .has_leak = has_leak}});
    is_released = core.step(after(s)).setpoint->release_weight;
  }
  EXPECT_TRUE(is_released);
}

TEST(ComingUp, HasComeUpWhenItsDepthSaysSoOrItsTimeIsOver) {
  ComingUp core(runtime::paper_mission(), in_search());
  (void)core.step(kBegin);
  EXPECT_FALSE(core.has_come_up(after(1)));
  core.take(fix(2, 0, 300));
  EXPECT_FALSE(core.has_come_up(after(3)));
  core.take(fix(4, 0, 1));
  EXPECT_TRUE(core.has_come_up(after(5)));
  EXPECT_FALSE(core.has_come_up(after(60))) << "an old depth is none";
  EXPECT_FALSE(core.has_come_up(after(3509)));
  EXPECT_TRUE(core.has_come_up(after(3511))) << "320 m and 25 m more at 0.1 m/s, and a minute";
}

TEST(ComingUp, AnswersAnAbortAndRefusesEveryOtherOrder) {
  ComingUp core(runtime::paper_mission(), in_search());
  for (const Order order : {Order::kAbort, Order::kStart})
    core.take({.arrival = kBegin, .port = 3, .sequence = 0, .value = runtime::command_of(order, kBegin, 5)});
  const runtime::Outputs outputs = core.step(kBegin);
  ASSERT_EQ(outputs.acknowledgements.size(), 2U);
  EXPECT_EQ(outputs.acknowledgements[0].outcome, CommandOutcome::kRepeated);
  EXPECT_EQ(outputs.acknowledgements[0].port, 3);
  EXPECT_EQ(outputs.acknowledgements[1].outcome, CommandOutcome::kNotInThisState);
  EXPECT_TRUE(core.step(after(1)).acknowledgements.empty());
}

TEST(ComingUp, CommandsNothingWhereTheSearchOnlyListened) {
  host::SafetyRecord record = in_search();
  record.is_engaged = false;
  ComingUp core(runtime::paper_mission(), record);
  const runtime::Outputs outputs = core.step(kBegin);
  EXPECT_FALSE(outputs.setpoint);
  EXPECT_EQ(outputs.health.state, MissionState::kAbort);
}

TEST(ComingUp, TellsWhatItsPortsReport) {
  ComingUp core(runtime::paper_mission(), in_search());
  for (const std::uint64_t received : {1U, 2U})
    core.take({.arrival = kBegin, .port = 1, .sequence = 0, .value = messages::PortReport{.port = 1, .received = received}});
  const runtime::Outputs outputs = core.step(kBegin);
  ASSERT_EQ(outputs.health.ports.size(), 1U);
  EXPECT_EQ(outputs.health.ports[0].received, 2U);
}

}  // namespace
}  // namespace earshot::board
