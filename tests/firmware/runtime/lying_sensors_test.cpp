// What the runtime makes of sensors that lie: each was once how a vehicle was lost.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

using config::Condition;

bool fires(const Outputs& outputs, Condition condition) {
  for (const messages::SafetyEvent& event : outputs.safety_events) {
    if (event.begins && event.condition == condition) return true;
  }
  return false;
}

config::Mission mission_of_a_torpedo() {
  config::Mission mission = paper_mission();
  mission.safety.vehicle.max_speed = MetersPerSecond{3};
  mission.safety.vehicle.ascent_speed = MetersPerSecond{1};
  return mission;
}

// The reproduction of a vehicle that stayed at 300 m for ever: its depth says 0 m, and any ABORT.
TEST(LyingSensors, BringsATorpedoUpWhoseDepthIsStuckAtNothing) {
  Rig rig = under_way(mission_of_a_torpedo());
  const auto second = [&rig] {
    rig.move();
    rig.depth = Meters{0};
    const Time measured = rig.now + Duration::seconds(1);
    rig.step({.navigation = rig.navigation_at(measured), .snr = messages::SnrMeasurement{.time = measured, .snr = rig.snr}});
  };
  for (int i = 0; i < 400; ++i) second();
  ASSERT_EQ(rig.state(), MissionState::kSearch);
  int moved_s = 0;
  rig.give(Order::kAbort);
  for (int s = 0; s < 4000; ++s) {
    second();
    moved_s += rig.setpoint.speed.value > 0.0 ? 1 : 0;
  }
  EXPECT_GE(moved_s, 3000) << "300 m at 0.1 m/s";
  EXPECT_EQ(rig.setpoint.speed, MetersPerSecond{0}) << "and not for ever";
}

TEST(LyingSensors, EndsASearchWhoseDepthDoesNotFollow) {
  Rig rig = under_way();
  for (int i = 0; i < 700 && rig.state() == MissionState::kSearch; ++i) {
    rig.move();
    rig.depth = Meters{0};
    rig.step({.navigation = rig.navigation_at(rig.now + Duration::seconds(1)),
              .snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}});
  }
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_TRUE(fires(rig.outputs, Condition::kDepthUnexplained));
}

// An overflowing conversion: undefined behaviour, and another deadline on another machine.
TEST(LyingSensors, TakesNoDepthThatIsNoneAfterATightenedLimit) {
  Rig rig = under_way();
  messages::OperatorCommand tighter = command_of(Order::kTighten, rig.now, ++rig.commands);
  tighter.limits.max_depth = Meters{200};
  rig.take(tighter);
  for (const double depth_m : {1e308, 1e300, 12'001.0, -101.0}) {
    messages::Navigation fix = rig.navigation_at(rig.now + Duration::seconds(1));
    fix.depth = Meters{depth_m};
    const std::uint64_t refused = rig.counters().navigation_refused;
    rig.step({.navigation = fix, .snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}});
    EXPECT_EQ(rig.counters().navigation_refused, refused + 1) << depth_m;
  }
  EXPECT_EQ(rig.state(), MissionState::kSearch);
}

// Each second a fix 15 m further north, dated now, and then the true one, dated a tenth of a second ago: 12 km off in 800 s.
TEST(LyingSensors, EndsASearchThatASecondSenderLeadsAway) {
  Rig rig = under_way();
  double walked_m = 0.0;
  int s = 0;
  for (; s < 800 && rig.state() == MissionState::kSearch; ++s) {
    rig.move();
    const Time measured = rig.now + Duration::seconds(1);
    rig.now = measured;
    messages::Navigation walked = rig.navigation_at(measured);
    walked.position = walked.position + at(walked_m += 15.0, 0);
    rig.take(walked);
    messages::Navigation late = rig.navigation_at(measured);
    late.time = late.time + Duration::milliseconds(-100);
    rig.take(late);
    rig.step_again({.snr = messages::SnrMeasurement{.time = rig.now, .snr = rig.snr}});
  }
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_LE(s, 16) << "25 m of noise, and ten seconds";
}

TEST(LyingSensors, EndsASearchWhoseFixesSayOneSpeedAndMakeAnother) {
  Rig rig = under_way();
  int s = 0;
  for (; s < 800 && rig.state() == MissionState::kSearch; ++s) {
    rig.sail();
    rig.position = rig.position + at(-13.0, 0);
  }
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_TRUE(fires(rig.outputs, Condition::kPlaceUnexplained));
  EXPECT_LE(s, 25) << "50 m of noise, 4 m/s of a current that nobody told of, and ten seconds";
}

// 8 m/s, of which 4 m/s of a current that nobody told of and 0.4 m/s are explained: less than 50 m in the 15 s between two jumps, each of
// which is believed as a dead reckoning that is put right.
TEST(LyingSensors, EndsASearchWhosePlaceDriftsBetweenJumps) {
  Rig rig = under_way();
  int s = 0;
  for (; s < 150 && rig.state() == MissionState::kSearch; ++s) {
    rig.sail();
    rig.position = rig.position + at(s % 15 == 14 ? -130.0 : -8.0, 0);
  }
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_TRUE(fires(rig.outputs, Condition::kPlaceUnexplained));
  EXPECT_LE(s, 80);
}

// No sensor lies: in an outage of five minutes an autopilot stops its vehicle and lets it come up by 120 m.
TEST(LyingSensors, AreNotSuspectedAfterAnOutage) {
  config::Mission mission = mission_of_a_torpedo();
  mission.safety.vehicle.max_current = MetersPerSecond{0.4};
  Rig rig = under_way(mission);
  for (int s = 0; s < 100; ++s) rig.sail();
  rig.now = rig.now + Duration::seconds(300);
  for (int s = 0; s < 400 && rig.state() == MissionState::kSearch; ++s) {
    rig.move();
    rig.depth = Meters{std::min(180.0 + 0.4 * s, 300.0)};
    const Time measured = rig.now + Duration::seconds(1);
    rig.step({.navigation = rig.navigation_at(measured), .snr = messages::SnrMeasurement{.time = measured, .snr = rig.snr}});
  }
  EXPECT_EQ(rig.state(), MissionState::kSearch);
}

TEST(LyingSensors, EndsASearchWhoseSetpointsDoNotLeave) {
  Rig rig = under_way();
  std::uint64_t unsent = 0;
  const auto second = [&](bool is_mute) {
    if (is_mute) rig.take(messages::UnsentSetpoints{.count = ++unsent});
    rig.sail();
  };
  for (int s = 0; s < 10; ++s) second(true);
  second(false);
  for (int s = 0; s < 11; ++s) second(true);
  EXPECT_EQ(rig.state(), MissionState::kSearch) << "10 s at a time";
  second(true);
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_TRUE(fires(rig.outputs, Condition::kSetpointsUnsent));
}

TEST(LyingSensors, HoldsThePortOfItsFixes) {
  Rig rig = under_way();
  const auto other = [&rig](double off_m) {
    messages::Navigation fix = rig.navigation_at(rig.now);
    fix.position = fix.position + at(off_m, 0);
    rig.runtime->take({.arrival = rig.now, .port = 3, .sequence = rig.sequence++, .value = fix});
  };
  for (int s = 0; s < 60; ++s) {
    rig.sail();
    other(20.0);
  }
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  EXPECT_EQ(rig.counters().navigation_refused, 0U) << "the other says the same";
  int s = 0;
  for (; s < 60 && rig.state() == MissionState::kSearch; ++s) {
    rig.sail();
    other(20.0 + 4.0 * s);
  }
  EXPECT_TRUE(fires(rig.outputs, Condition::kNavigationDisputed));
  EXPECT_LE(s, 18);
}

}  // namespace
}  // namespace earshot::runtime
