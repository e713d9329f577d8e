#include "firmware/safety/supervisor.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/firmware/safety/rule_rig.hpp"

namespace earshot::safety {
namespace {

using config::Condition;
using config::Response;
using config::Rule;

class Supervised : public testing::Test {
 protected:
  void arm(const Rule& rule) { ASSERT_EQ(mission_.safety.rules.push_back(rule), Status::kOk); }
  void begin() {
    supervisor_.configure(mission_);
    situation_ = well(mission_);
    began_ = situation_.now;
    situation_.vehicle = messages::VehicleStatus{.time = situation_.now, .altitude = Meters{100}, .battery_percent = 50};
  }
  /// All is well for another second, but for what the test has put into the situation.
  SafetyEvents second() {
    const Time now = situation_.now + Duration::seconds(1);
    situation_.now = now;
    situation_.snr = now;
    static_cast<void>(situation_.navigation.take(now, fix_at(now, at(5000 + 2.0 * (now - began_).to_seconds(), 5000)), true));
    return supervisor_.watch(mission_, situation_);
  }

  config::Mission mission_ = fenced_mission();
  Situation situation_;
  Time began_;
  Supervisor supervisor_;
};

Rule battery_below(double percent, Response response, std::int64_t for_s = 0, bool is_latched = false) {
  return {.condition = Condition::kBattery,
          .limit = percent,
          .persistence = Duration::seconds(for_s),
          .response = response,
          .is_latched = is_latched};
}

TEST_F(Supervised, SaysNothingWhileAllIsWell) {
  begin();
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(second().empty());
  EXPECT_EQ(supervisor_.response(), std::nullopt);
  EXPECT_EQ(supervisor_.cause(), std::nullopt);
}

TEST_F(Supervised, ActsOnceAConditionHasLastedAndNotBefore) {
  arm(battery_below(20, Response::kReturn, 3));
  begin();
  situation_.vehicle->battery_percent = 20;
  EXPECT_TRUE(second().empty()) << "20 is not below 20";
  situation_.vehicle->battery_percent = 19.9;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(second().empty());
  const SafetyEvents events = second();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0], (messages::SafetyEvent{.time = situation_.now,
                                              .rule = static_cast<std::uint8_t>(standing_rules(mission_)),
                                              .condition = Condition::kBattery,
                                              .response = Response::kReturn,
                                              .begins = true,
                                              .measure = 19.9,
                                              .limit = 20}));
  EXPECT_EQ(supervisor_.response(), Response::kReturn);
  EXPECT_EQ(supervisor_.cause(), Condition::kBattery);
  EXPECT_TRUE(supervisor_.acts_on(Condition::kBattery));
  EXPECT_FALSE(supervisor_.acts_on(Condition::kLeak));
  EXPECT_TRUE(second().empty()) << "it is told once";
}

TEST_F(Supervised, BeginsToCountAnewWhenAConditionWasInterrupted) {
  arm(battery_below(20, Response::kReturn, 3));
  begin();
  for (int i = 0; i < 10; ++i) {
    situation_.vehicle->battery_percent = i % 3 == 2 ? 21 : 19;
    EXPECT_TRUE(second().empty()) << i;
  }
}

/// Places that nobody believes, depths that were told to nobody, and seconds in which all is well.
class Doubted : public Supervised {
 protected:
  void jump(int seconds) {
    for (int i = 0; i < seconds; ++i) {
      const Time now = situation_.now + Duration::seconds(1);
      static_cast<void>(situation_.navigation.take(now, fix_at(now, at(9000, 9000)), true));
      (void)second();
    }
  }
  /// The vehicle says another depth than it was told, but not one that it cannot have come to from one second to the next.
  void be_deep(int seconds) {
    situation_.depth = {};
    situation_.depth.take(fix_at(situation_.now, at(5000, 5000)));
    situation_.depth.note_order(situation_.now, {.heading = {}, .speed = MetersPerSecond{2}, .depth = Meters{300}, .waypoint = {}},
                                mission_.safety.vehicle);
    situation_.depth.take(fix_at(situation_.now, at(5000, 5000), 0.0, 200.0));
    rest(seconds);
    situation_.depth = {};
  }
  void rest(int seconds) {
    for (int i = 0; i < seconds; ++i) (void)second();
  }
};

// A jump is remembered for two seconds.
TEST_F(Doubted, AddsUpWhatIsDoubtedInTurns) {
  begin();
  for (int i = 0; i < 2; ++i) {
    jump(2);
    rest(2);
    be_deep(1);
  }
  EXPECT_FALSE(supervisor_.response()) << "nine and a half seconds at the most";
  be_deep(3);
  EXPECT_EQ(supervisor_.cause(), Condition::kDepthUnexplained);
}

TEST_F(Doubted, ForgetsHalfAsFastAsItCounts) {
  begin();
  be_deep(9);
  rest(20);
  be_deep(9);
  EXPECT_FALSE(supervisor_.response());
  rest(4);  // two of nine seconds
  be_deep(2);
  EXPECT_FALSE(supervisor_.response());
  be_deep(2);
  EXPECT_TRUE(supervisor_.acts_on(Condition::kDepthUnexplained));
}

TEST_F(Doubted, IsNothingForWhatComesLessThanAThirdOfTheTime) {
  begin();
  for (int i = 0; i < 100; ++i) {
    be_deep(3);
    rest(7);
  }
  EXPECT_FALSE(supervisor_.response());
  for (int i = 0; i < 10; ++i) {
    be_deep(4);
    rest(6);
  }
  EXPECT_TRUE(supervisor_.acts_on(Condition::kDepthUnexplained));
}

TEST_F(Doubted, LeavesAMissionsOwnRuleToItsOwnTime) {
  arm({.condition = Condition::kDepthUnexplained, .limit = 0, .persistence = Duration::seconds(8), .response = Response::kHold});
  begin();
  for (int i = 0; i < 3; ++i) {
    be_deep(5);
    rest(3);
  }
  EXPECT_NE(supervisor_.response(), Response::kHold);
}

TEST_F(Supervised, EndsWithItsConditionUnlessItIsLatched) {
  arm(battery_below(20, Response::kWarn));
  arm(battery_below(10, Response::kSurface, 0, true));
  begin();
  situation_.vehicle->battery_percent = 5;
  EXPECT_EQ(second().size(), 2U);
  situation_.vehicle->battery_percent = 50;
  const SafetyEvents events = second();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].response, Response::kWarn);
  EXPECT_FALSE(events[0].begins);
  EXPECT_EQ(events[0].measure, 50.0);
  EXPECT_EQ(supervisor_.response(), Response::kSurface);
}

TEST_F(Supervised, LetsTheStrongestOfSeveralAct) {
  arm(battery_below(20, Response::kReturn));
  arm({.condition = Condition::kLeak, .limit = 0, .persistence = {}, .response = Response::kRelease, .is_latched = true});
  arm(battery_below(30, Response::kHold));
  begin();
  situation_.vehicle->battery_percent = 5;
  (void)second();
  EXPECT_EQ(supervisor_.response(), Response::kReturn);
  situation_.vehicle->has_leak = true;
  (void)second();
  EXPECT_EQ(supervisor_.response(), Response::kRelease);
  EXPECT_EQ(supervisor_.cause(), Condition::kLeak);
}

TEST_F(Supervised, LeavesARuleAtRestWhoseMeasureNobodyKnows) {
  arm(battery_below(20, Response::kReturn));
  begin();
  situation_.vehicle.reset();
  EXPECT_TRUE(second().empty());
}

TEST_F(Supervised, GoesOnWithWhatWasLastKnownOfAMeasureThatIsKnownNoLonger) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  arm({.condition = Condition::kAltitude, .limit = 10, .persistence = Duration::seconds(3), .response = Response::kSurface});
  begin();
  situation_.vehicle->altitude = Meters{kUnknown};
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(second().empty()) << "nothing was ever known";
  situation_.vehicle->altitude = Meters{5};
  EXPECT_TRUE(second().empty());
  situation_.vehicle->altitude = Meters{kUnknown};
  EXPECT_TRUE(second().empty());
  EXPECT_TRUE(second().empty());
  const SafetyEvents events = second();
  ASSERT_EQ(events.size(), 1U) << "too near to the bottom to see it is no way out";
  EXPECT_TRUE(events[0].begins);
  EXPECT_EQ(events[0].measure, 5.0);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(second().empty());
  EXPECT_EQ(supervisor_.response(), Response::kSurface);
  situation_.vehicle->altitude = Meters{30};
  EXPECT_EQ(second().size(), 1U);
  EXPECT_EQ(supervisor_.response(), std::nullopt);
}

TEST_F(Supervised, WatchesAfterAMissionForWhatReleasesTheWeightOnly) {
  arm(battery_below(20, Response::kAbort));
  arm({.condition = Condition::kLeak, .limit = 0, .persistence = Duration::seconds(2), .response = Response::kRelease, .is_latched = true});
  begin();
  situation_.vehicle->battery_percent = 5;
  situation_.vehicle->has_leak = true;
  for (int i = 0; i < 2; ++i) {
    situation_.now = situation_.now + Duration::seconds(1);
    EXPECT_TRUE(supervisor_.watch_for_release(mission_, situation_).empty()) << "an abort says nothing new";
  }
  situation_.now = situation_.now + Duration::seconds(1);
  ASSERT_EQ(supervisor_.watch_for_release(mission_, situation_).size(), 1U);
  EXPECT_EQ(supervisor_.cause(), Condition::kLeak);
}

TEST_F(Supervised, HasRulesThatNoMissionCanSwitchOff) {
  const config::Mission bare = [] {
    config::Mission mission = fenced_mission();
    mission.safety = {};
    return mission;
  }();
  EXPECT_EQ(standing_rules(bare), 13U);
  EXPECT_EQ(standing_rules(mission_), 14U) << "and one about the fence";
  arm(battery_below(20, Response::kReturn));
  EXPECT_EQ(rules_of(mission_).size(), 15U);
  EXPECT_EQ(rules_of(mission_)[14], mission_.safety.rules[0]);
  for (const Rule& rule : rules_of(bare)) EXPECT_EQ(rule.response, Response::kAbort);
}

// Its circle would end 0.35 m beyond the save polygon.
TEST_F(Supervised, SteersBackFromTheLeastThatLiesBeyondTheFence) {
  begin();
  situation_ = well(mission_, at(10'066.5, 5000));
  ASSERT_EQ(supervisor_.watch(mission_, situation_).size(), 1U);
  EXPECT_EQ(supervisor_.response(), Response::kSteerBack);
}

TEST_F(Supervised, KnowsThatItsFirstRuleActs) {
  begin();
  EXPECT_FALSE(supervisor_.acts_on(Condition::kNavigationAge));
  situation_.now = situation_.now + Duration::seconds(6);
  ASSERT_EQ(supervisor_.watch(mission_, situation_).size(), 1U);
  EXPECT_TRUE(supervisor_.acts_on(Condition::kNavigationAge));
}

// 1000 m at 2 m/s take 500 s.
TEST_F(Supervised, AbortsAVehicleThatMakesNoWayInThreeTimesWhatALegTakes) {
  begin();
  situation_.track.set_waypoint(at(9000, 5000));
  for (int i = 0; i < 1500; ++i) EXPECT_TRUE(second().empty()) << i;
  EXPECT_EQ(second().size(), 1U);
  EXPECT_EQ(supervisor_.cause(), Condition::kNoProgress);
  EXPECT_EQ(supervisor_.response(), Response::kAbort);
}

TEST_F(Supervised, TellsTheFirstOfSeveralRulesThatWantTheSame) {
  begin();
  situation_.now = situation_.now + Duration::seconds(100);  // navigation and SNR are too old, both in one turn
  (void)supervisor_.watch(mission_, situation_);
  EXPECT_TRUE(supervisor_.acts_on(Condition::kSnrAge));
  EXPECT_EQ(supervisor_.cause(), Condition::kNavigationAge);
}

class OrderedToComeUp : public Supervised {
 protected:
  void at_depth(double depth_m, int seconds) {
    for (int i = 0; i < seconds; ++i) {
      const Time now = situation_.now + Duration::seconds(1);
      situation_ = well(mission_, at(5000 + 2 * i, 5000), 0.0, depth_m);
      situation_.now = now;
      situation_.snr = now;
      messages::Navigation fix = fix_at(now, at(5000 + 2 * i, 5000), 0.0, depth_m);
      static_cast<void>(situation_.navigation.take(now, fix, true));
      (void)supervisor_.watch(mission_, situation_);
    }
  }
  void tighten(double max_depth_m) {
    mission_.max_depth = Meters{max_depth_m};
    supervisor_.tighten(mission_);
  }
};

// Of 320 m; 100 m at 0.1 m/s and a minute.
TEST_F(OrderedToComeUp, HasTheTimeToAndNoLonger) {
  begin();
  tighten(200);
  at_depth(300, 1060);
  EXPECT_FALSE(supervisor_.acts_on(Condition::kDepth));
  at_depth(300, 5);
  EXPECT_FALSE(supervisor_.acts_on(Condition::kDepth)) << "5 s are nothing yet";
  at_depth(300, 1);
  EXPECT_TRUE(supervisor_.acts_on(Condition::kDepth));
}

TEST_F(OrderedToComeUp, MayGoNoDeeperMeanwhileThanItWasAndALittle) {
  begin();
  tighten(100);
  at_depth(250, 1);
  at_depth(275, 10);
  EXPECT_FALSE(supervisor_.acts_on(Condition::kDepth));
  at_depth(275.5, 6);
  EXPECT_TRUE(supervisor_.acts_on(Condition::kDepth));
}

TEST_F(OrderedToComeUp, TwiceIsHeldToWhatItReachedOfTheFirst) {
  begin();
  tighten(200);
  at_depth(300, 1);
  tighten(150);
  for (int depth_m = 299; depth_m > 180; --depth_m) at_depth(depth_m, 2);
  EXPECT_FALSE(supervisor_.acts_on(Condition::kDepth));
  at_depth(210, 7);
  EXPECT_TRUE(supervisor_.acts_on(Condition::kDepth)) << "from 181 m it may go to 206 m";
}

TEST_F(OrderedToComeUp, AgainHasTheTimeAnew) {
  begin();
  tighten(200);
  at_depth(300, 1000);
  tighten(190);
  at_depth(300, 1000);
  EXPECT_FALSE(supervisor_.acts_on(Condition::kDepth));
}

TEST_F(OrderedToComeUp, IsHeldToATighterDepthFromWhenItHasComeThere) {
  begin();
  mission_.max_depth = Meters{200};
  supervisor_.tighten(mission_);
  at_depth(300, 20);
  EXPECT_FALSE(supervisor_.acts_on(Condition::kDepth)) << "on its way up";
  at_depth(200, 1);  // as deep as it may be
  at_depth(201, 4);
  EXPECT_FALSE(supervisor_.acts_on(Condition::kDepth));
  at_depth(201, 4);
  EXPECT_TRUE(supervisor_.acts_on(Condition::kDepth));
}

TEST_F(Supervised, ForgetsEverythingWithANewMission) {
  arm(battery_below(20, Response::kSurface, 0, true));
  begin();
  situation_.vehicle->battery_percent = 5;
  (void)second();
  ASSERT_TRUE(supervisor_.response());
  supervisor_.configure(mission_);
  EXPECT_FALSE(supervisor_.response());
}

}  // namespace
}  // namespace earshot::safety
