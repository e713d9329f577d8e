#include "firmware/safety/check.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "firmware/safety/supervisor.hpp"
#include "tests/firmware/safety/rule_rig.hpp"

namespace earshot::safety {
namespace {

using config::Condition;
using config::Response;
using config::Rule;

SafetyComplaint complaint_of(const std::function<void(config::Mission&)>& change) {
  config::Mission mission = fenced_mission();
  change(mission);
  return safety::check(mission);
}

SafetyFault fault_of(const std::function<void(config::Mission&)>& change) {
  return complaint_of(change).fault;
}

SafetyComplaint complaint_of_rules(std::initializer_list<Rule> rules) {
  return complaint_of([&rules](config::Mission& mission) {
    for (const Rule& rule : rules) static_cast<void>(mission.safety.rules.push_back(rule));
  });
}

Rule rule(Condition condition, double limit, Response response, std::int64_t for_s = 0, bool is_latched = false) {
  return {.condition = condition, .limit = limit, .persistence = Duration::seconds(for_s), .response = response, .is_latched = is_latched};
}

TEST(SafetyCheck, AcceptsAFenceAndRulesThatFit) {
  EXPECT_TRUE(safety::check(fenced_mission()).is_none());
  EXPECT_TRUE(complaint_of([](config::Mission& mission) { mission.safety = {}; }).is_none());
  EXPECT_TRUE(complaint_of_rules({rule(Condition::kBattery, 20, Response::kReturn), rule(Condition::kBattery, 10, Response::kSurface),
                                  rule(Condition::kLeak, 0, Response::kRelease, 2, true)})
                  .is_none());
}

TEST(SafetyCheck, RefusesAVehicleThatCannotBe) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {kNan, -0.1, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(fault_of([wrong](config::Mission& m) { m.safety.vehicle.turn_radius = Meters{wrong}; }), SafetyFault::kVehicle);
    EXPECT_EQ(fault_of([wrong](config::Mission& m) { m.safety.vehicle.hold_speed = MetersPerSecond{wrong}; }), SafetyFault::kVehicle);
    EXPECT_EQ(fault_of([wrong](config::Mission& m) { m.safety.vehicle.ascent_speed = MetersPerSecond{wrong}; }), SafetyFault::kVehicle);
    EXPECT_EQ(fault_of([wrong](config::Mission& m) { m.safety.vehicle.battery_percent_per_km = wrong; }), SafetyFault::kVehicle);
  }
  for (const double wrong : {kNan, 0.09, 5.1})
    EXPECT_EQ(fault_of([wrong](config::Mission& m) { m.safety.vehicle.ascent_rate = MetersPerSecond{wrong}; }), SafetyFault::kVehicle);
  for (const double wrong : {kNan, 0.0, 10.1})
    EXPECT_EQ(fault_of([wrong](config::Mission& m) { m.safety.vehicle.surface_depth = Meters{wrong}; }), SafetyFault::kVehicle);
  for (const double right : {0.1, 5.0}) {
    EXPECT_EQ(fault_of([right](config::Mission& m) { m.safety.vehicle.ascent_rate = MetersPerSecond{right}; }), SafetyFault::kNone);
    EXPECT_EQ(fault_of([right](config::Mission& m) { m.safety.vehicle.surface_depth = Meters{2 * right}; }), SafetyFault::kNone);
  }
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.vehicle.max_speed = MetersPerSecond{1.9}; }), SafetyFault::kVehicle);
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.vehicle.max_speed = MetersPerSecond{2}; }), SafetyFault::kNone);
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.vehicle.max_current = MetersPerSecond{2}; }), SafetyFault::kVehicle)
      << "it could not come back against it";
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.vehicle.hold_speed = MetersPerSecond{2}; }), SafetyFault::kNone);
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.vehicle.hold_speed = MetersPerSecond{2.1}; }), SafetyFault::kVehicle);
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.vehicle.ascent_speed = MetersPerSecond{3}; }), SafetyFault::kNone);
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.vehicle.ascent_speed = MetersPerSecond{3.1}; }), SafetyFault::kVehicle);
}

// A rate that it cannot make would have it told to stop while it is still below.
TEST(SafetyCheck, RefusesAVehicleThatRisesFasterThanItMoves) {
  const auto fault = [](double speed_mps, double rate_mps) {
    return fault_of([&](config::Mission& m) {
      m.safety.vehicle.ascent_speed = MetersPerSecond{speed_mps};
      m.safety.vehicle.ascent_rate = MetersPerSecond{rate_mps};
    });
  };
  EXPECT_EQ(fault(1.0, 1.0), SafetyFault::kNone);
  EXPECT_EQ(fault(1.0, 1.01), SafetyFault::kVehicle);
  EXPECT_EQ(fault(0.0, 5.0), SafetyFault::kNone) << "it floats up, and moves by nothing else";
}

TEST(SafetyCheck, RefusesAFenceThatIsNone) {
  for (std::size_t i = 0; i < 3; ++i) {
    const SafetyComplaint complaint = complaint_of([i](config::Mission& m) {
      config::Fence& fence = *m.safety.fence;
      (i == 0 ? fence.inside : i == 1 ? fence.save : fence.halt) = polygon({at(0, 0), at(0, 1), at(1, 0), at(1, 1)});
    });
    EXPECT_EQ(complaint.fault, SafetyFault::kFence);
    EXPECT_EQ(complaint.index, i);
    EXPECT_EQ(complaint.polygon.fault, PolygonFault::kCrossesItself);
  }
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.fence->inside = square(-101, 10'000); }), SafetyFault::kInsideBeyondSave);
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.fence->inside = square(501, 10'000); }), SafetyFault::kSearchBeyondFence)
      << "way-points lie between 500 and 9500 m";
}

// A turn takes 20 m (1 + (pi/2) / 4 + 0.571 / 16) = 28.568 m. Before it (2 + 0.5) m/s x (10 + 3) s = 32.5 m straight out; with fixes that
// are stale after 5 s those were 20 m, and a turn beside a narrow fence takes 20 m (1 + (pi/2) / 4) = 27.854 m more.
TEST(SafetyCheck, AsksForRoomToTurnRoundBetweenSaveAndHalt) {
  config::Mission mission = fenced_mission();
  mission.navigation_timeout = Duration::seconds(10);
  EXPECT_NEAR(margin_to_halt(mission).value, 32.5 + 28.567731633974483, 1e-9);
  EXPECT_NEAR(margin_to_halt(fenced_mission()).value, 27.853981633974483 + 28.567731633974483, 1e-9);
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.fence->halt = square(-156.43, 10'300); }), SafetyFault::kNone);
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.fence->halt = square(-156.42, 10'300); }), SafetyFault::kSaveNearHalt);
}

TEST(SafetyCheck, RefusesAZoneThatIsNoneAndASafePointThatIsNotSafe) {
  const SafetyComplaint complaint = complaint_of([](config::Mission& m) {
    static_cast<void>(m.safety.no_surface.push_back(square(0, 100)));
    static_cast<void>(m.safety.no_surface.push_back(polygon({at(0, 0), at(0, 1)})));
  });
  EXPECT_EQ(complaint.fault, SafetyFault::kZone);
  EXPECT_EQ(complaint.index, 1U);
  EXPECT_EQ(fault_of([](config::Mission& m) {
              static_cast<void>(m.safety.no_surface.push_back(polygon({at(0, 0), at(0, 1)})));
            }),
            SafetyFault::kZone)
      << "the first";
  EXPECT_EQ(fault_of([](config::Mission& m) { m.safety.safe_point = at(-50, 0); }), SafetyFault::kSafePoint);
  EXPECT_EQ(fault_of([](config::Mission& m) { static_cast<void>(m.safety.no_surface.push_back(square(4000, 6000))); }),
            SafetyFault::kSafePoint);
  EXPECT_EQ(fault_of([](config::Mission& m) {
              m.safety.fence.reset();
              m.safety.safe_point = at(-50, 0);
            }),
            SafetyFault::kSafePoint)
      << "without a fence, outside the operating area";
}

TEST(SafetyCheck, RefusesARuleThatCannotBe) {
  const SafetyComplaint unknown =
      complaint_of_rules({rule(Condition::kLeak, 0, Response::kWarn), rule(static_cast<Condition>(99), 0, Response::kWarn)});
  EXPECT_EQ(unknown.fault, SafetyFault::kRuleUnknown);
  EXPECT_EQ(unknown.index, 1U);
  EXPECT_EQ(complaint_of_rules({rule(static_cast<Condition>(config::kConditions), 0, Response::kWarn)}).fault, SafetyFault::kRuleUnknown);
  EXPECT_EQ(complaint_of_rules({rule(Condition::kLeak, 0, static_cast<Response>(7))}).fault, SafetyFault::kRuleUnknown);
  EXPECT_EQ(complaint_of_rules({rule(Condition::kBattery, 100.1, Response::kWarn)}).fault, SafetyFault::kRuleLimit);
  EXPECT_EQ(complaint_of_rules({rule(Condition::kLeak, 1, Response::kWarn)}).fault, SafetyFault::kRuleLimit);
  EXPECT_EQ(complaint_of_rules({rule(Condition::kBattery, 10, Response::kWarn, -1)}).fault, SafetyFault::kRuleLimit);
  EXPECT_EQ(complaint_of_rules({rule(Condition::kBattery, std::numeric_limits<double>::quiet_NaN(), Response::kWarn)}).fault,
            SafetyFault::kRuleLimit);
}

// Fixes a second apart cannot tell 200 degrees a second from 160 the other way.
TEST(SafetyCheck, RefusesALimitOnTheTurnRateThatASpinMayNeverSeemToReach) {
  EXPECT_TRUE(complaint_of_rules({rule(Condition::kTurnRate, 90, Response::kHold)}).is_none());
  EXPECT_EQ(complaint_of_rules({rule(Condition::kTurnRate, 91, Response::kHold)}).fault, SafetyFault::kRuleLimit);
}

TEST(SafetyCheck, RefusesARuleThatLacksAPlaceToGoTo) {
  const auto without = [](bool fence, const Rule& own) {
    return fault_of([&](config::Mission& m) {
      if (fence) m.safety.fence.reset();
      if (!fence) m.safety.safe_point.reset();
      static_cast<void>(m.safety.rules.push_back(own));
    });
  };
  EXPECT_EQ(without(true, rule(Condition::kBattery, 10, Response::kSteerBack)), SafetyFault::kRuleNeedsFence);
  EXPECT_EQ(without(true, rule(Condition::kOutsideFence, 10, Response::kWarn)), SafetyFault::kRuleNeedsFence);
  EXPECT_EQ(without(false, rule(Condition::kBattery, 10, Response::kReturn)), SafetyFault::kRuleNeedsSafePoint);
  EXPECT_EQ(without(false, rule(Condition::kBatteryAtHome, 10, Response::kSurface)), SafetyFault::kRuleNeedsSafePoint);
}

TEST(SafetyCheck, TakesTiersAndWayPointsThatAlmostTouch) {
  config::Mission mission = fenced_mission();
  mission.edge_margin = Meters{0.5};  // the polygon inside is the area
  mission.safety.fence->save = square(-0.5, 10'000.5);
  EXPECT_EQ(safety::check(mission).fault, SafetyFault::kNone);
}

TEST(SafetyCheck, NamesWhicheverRuleHasNothingToDo) {
  const SafetyComplaint complaint =
      complaint_of_rules({rule(Condition::kBattery, 10, Response::kWarn), rule(Condition::kNavigationAge, 6, Response::kSurface)});
  EXPECT_EQ(complaint.fault, SafetyFault::kRuleNeverActs);
  EXPECT_EQ(complaint.index, 1U);
}

TEST(SafetyCheck, RefusesARuleThatAnotherLeavesNothingToDo) {
  const SafetyComplaint complaint =
      complaint_of_rules({rule(Condition::kBattery, 10, Response::kWarn), rule(Condition::kBattery, 20, Response::kReturn)});
  EXPECT_EQ(complaint.fault, SafetyFault::kRuleNeverActs) << "below 10 it has returned since 20";
  EXPECT_EQ(complaint.index, 0U);
  EXPECT_EQ(complaint.other, standing_rules(fenced_mission()) + 1);
  EXPECT_EQ(complaint_of_rules({rule(Condition::kLeak, 0, Response::kAbort), rule(Condition::kLeak, 0, Response::kAbort)}).fault,
            SafetyFault::kRuleNeverActs);
  EXPECT_EQ(complaint_of_rules({rule(Condition::kBattery, 10, Response::kWarn), rule(Condition::kBattery, 10, Response::kWarn)}).fault,
            SafetyFault::kRuleNeverActs);
  EXPECT_EQ(complaint_of_rules({rule(Condition::kNavigationAge, 6, Response::kSurface)}).fault, SafetyFault::kRuleNeverActs)
      << "every mission aborts at 5 s";
  // Later but sooner sure, or latched: each has something to do.
  EXPECT_TRUE(
      complaint_of_rules({rule(Condition::kBattery, 10, Response::kWarn), rule(Condition::kBattery, 20, Response::kReturn, 60)}).is_none());
  EXPECT_TRUE(
      complaint_of_rules({rule(Condition::kBattery, 20, Response::kHold, 0, true), rule(Condition::kBattery, 20, Response::kReturn)})
          .is_none());
  EXPECT_TRUE(complaint_of_rules({rule(Condition::kNavigationAge, 3, Response::kHold)}).is_none());
}

}  // namespace
}  // namespace earshot::safety
