#include "firmware/runtime/intake.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/place.hpp"

namespace earshot::runtime {
namespace {

using messages::MissionState;

constexpr Time kArrived{1'000'000'000};
constexpr Duration kOneSecond = Duration::seconds(1);

config::Mission some_mission() {
  config::Mission mission;
  mission.navigation_timeout = Duration::seconds(5);
  mission.snr_timeout = Duration::seconds(30);
  return mission;
}

/// An intake of some mission in one state.
struct Taken {
  config::Mission mission = some_mission();
  MissionState state = MissionState::kStandby;
  Intake intake;

  explicit Taken(MissionState of = MissionState::kStandby) : state(of) { intake.configure(mission); }

  template <class Value>
  void take(Time time, const Value& value, std::uint8_t port = 1) {
    intake.take({.mission = mission, .state = state, .time = time, .port = port}, value);
  }
  void take_fix(Time time, NorthEast position = at(0, 0)) {
    take(time, messages::Navigation{.time = time, .position = position, .depth = Meters{0}, .heading = {}, .speed = {}});
  }
  void take_snr(Time time, double snr_db = 3.0) { take(time, messages::SnrMeasurement{.time = time, .snr = Decibels{snr_db}}); }
};

TEST(Intake, KnowsNothingFreshBeforeAnythingCame) {
  const Taken taken;
  EXPECT_FALSE(taken.intake.navigation_is_fresh(taken.mission, kArrived));
  EXPECT_FALSE(taken.intake.snr_is_fresh(taken.mission, kArrived));
}

TEST(Intake, HoldsAFixForFreshUpToItsTimeoutAndNoLonger) {
  Taken taken;
  taken.take_fix(kArrived);
  EXPECT_TRUE(taken.intake.navigation_is_fresh(taken.mission, kArrived + Duration{5'000'000}));
  EXPECT_FALSE(taken.intake.navigation_is_fresh(taken.mission, kArrived + Duration{5'000'001}));
}

TEST(Intake, HoldsAMeasurementForFreshUpToItsTimeoutAndNoLonger) {
  Taken taken;
  taken.take_snr(kArrived);
  EXPECT_TRUE(taken.intake.snr_is_fresh(taken.mission, kArrived + Duration{30'000'000}));
  EXPECT_FALSE(taken.intake.snr_is_fresh(taken.mission, kArrived + Duration{30'000'001}));
}

TEST(Intake, WaitsForTheAutopilotOnlyWhereTheMissionDoes) {
  Taken taken;
  taken.mission.authority.autopilot_timeout = Duration::seconds(10);
  EXPECT_FALSE(taken.intake.autopilot_is_connected(taken.mission, kArrived));
  taken.mission.authority.autopilot_timeout = Duration{};
  EXPECT_TRUE(taken.intake.autopilot_is_connected(taken.mission, kArrived));
}

TEST(Intake, CountsWhatItRefusesAndKeepsWhatItHas) {
  Taken taken;
  taken.take_fix(kArrived, at(1, 2));
  taken.take_snr(kArrived, 3.0);
  taken.take_fix(kArrived + Duration::seconds(-1));
  taken.take_snr(kArrived + Duration::seconds(-1));
  EXPECT_EQ(taken.intake.counters().navigation_refused, 1U);
  EXPECT_EQ(taken.intake.counters().snr_refused, 1U);
  EXPECT_EQ(taken.intake.fix().position, at(1, 2));
  EXPECT_EQ(taken.intake.reception({}, kArrived).snr, Decibels{3.0});
}

TEST(Intake, CountsTheWayOfASearchOnly) {
  for (const MissionState state : {MissionState::kStandby, MissionState::kSearch}) {
    Taken taken(state);
    taken.take_fix(kArrived);
    taken.take_snr(kArrived);
    taken.intake.begin_search(kArrived);
    for (int s = 1; s <= 100; ++s) taken.take_fix(kArrived + Duration::seconds(s), at(s, 0));
    const double way_m = taken.intake.situation().track.distance().value;
    EXPECT_EQ(way_m, state == MissionState::kSearch ? 100.0 : 0.0) << "in pieces of 50 m";
  }
}

TEST(Intake, HearsTheBearingOfTheNewestMeasurementWhenItIsLessThanASecondOlder) {
  const auto bearing_dated = [](Duration before) {
    Taken taken;
    taken.take(kArrived, messages::BearingMeasurement{.time = kArrived + Duration{-before.us},
                                                      .bearing = {.direction = Radians{1.5}, .deviation = Radians{0.1}}});
    taken.take_snr(kArrived);
    return taken.intake.reception({}, kArrived).bearing;
  };
  ASSERT_TRUE(bearing_dated(Duration{999'999}));
  EXPECT_EQ(bearing_dated(Duration{999'999})->direction, Radians{1.5});
  EXPECT_FALSE(bearing_dated(kOneSecond));
}

TEST(Intake, HearsInALegOnlyWhatCameInIt) {
  constexpr config::ListeningWindow kLoudest{config::Listening::kLoudest, Duration::seconds(30)};
  Taken taken;
  taken.take_snr(kArrived, 20.0);
  taken.intake.begin_leg(kArrived + kOneSecond);
  taken.take_snr(kArrived + Duration::seconds(2), 4.0);
  EXPECT_EQ(taken.intake.reception(kLoudest, kArrived + Duration::seconds(2)).snr, Decibels{4.0});
}

TEST(Intake, KnowsSinceWhenNoSetPointCouldLeave) {
  Taken taken;
  taken.intake.note_mute(kArrived);
  EXPECT_FALSE(taken.intake.situation().mute_since);
  for (int s = 1; s <= 3; ++s) {
    taken.take(kArrived, messages::UnsentSetpoints{});
    taken.intake.note_mute(kArrived + Duration::seconds(s));
  }
  ASSERT_TRUE(taken.intake.situation().mute_since);
  EXPECT_EQ(*taken.intake.situation().mute_since, kArrived + kOneSecond) << "the first of them";
  taken.intake.note_mute(kArrived + Duration::seconds(4));
  EXPECT_FALSE(taken.intake.situation().mute_since) << "one has left";
}

TEST(Intake, TellsTheRulesOfAPolicyThatGaveNoNumberAndOfAVehicleThatTheFenceHas) {
  Taken taken;
  EXPECT_FALSE(taken.intake.situation().is_policy_unhealthy);
  taken.intake.note_unhealthy_policy();
  EXPECT_TRUE(taken.intake.situation().is_policy_unhealthy);
  taken.intake.note_steered_back(true);
  EXPECT_TRUE(taken.intake.situation().is_steered_back);
  taken.intake.note_steered_back(false);
  EXPECT_FALSE(taken.intake.situation().is_steered_back);
}

TEST(Intake, KeepsTheNewestReportOfEachPort) {
  Taken taken;
  taken.take(kArrived, messages::PortReport{.port = 2, .link_up = true});
  taken.take(kArrived, messages::PortReport{.port = 3, .link_up = true});
  taken.take(kArrived, messages::PortReport{.port = 2, .link_up = false});
  ASSERT_EQ(taken.intake.ports().size(), 2U);
  EXPECT_FALSE(taken.intake.ports()[0].link_up);
  EXPECT_TRUE(taken.intake.ports()[1].link_up);
}

}  // namespace
}  // namespace earshot::runtime
