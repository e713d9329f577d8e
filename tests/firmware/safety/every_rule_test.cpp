// Each condition that a rule may watch: a search in which the rule fires, and one in which it rests. The table of firmware/safety/README.md
// is made of them.

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "firmware/safety/supervisor.hpp"
#include "tests/firmware/safety/rule_rig.hpp"

namespace earshot::safety {
namespace {

using config::Condition;
using config::ConditionTraits;

constexpr Duration kPersistence = Duration::seconds(2);

struct Case {
  const char* words;
  void (*arrange)(Situation&);  ///< of a situation in which all is well
};

struct Scenario {
  Condition condition;
  double limit;
  Case fires;
  Case rests;
};

Time ago(const Situation& situation, std::int64_t seconds) {
  return Time{situation.now.us - Duration::seconds(seconds).us};
}

void place(Situation& situation, const messages::Navigation& fix) {
  const config::Mission mission = fenced_mission();
  situation.navigation = NavigationJudge(mission.safety.vehicle, mission.navigation_timeout);
  static_cast<void>(situation.navigation.take(fix.time, fix, true));
  situation.track.begin(fix);
}

/// Two fixes four seconds apart, the last of them now.
void move(Situation& situation, NorthEast from, NorthEast to, double turned_rad = 0.0, double sunk_m = 0.0, double speed_mps = 2.0) {
  const Time before = ago(situation, 4);
  place(situation, fix_at(before, from));
  messages::Navigation fix = fix_at(situation.now, to, turned_rad, 300.0 + sunk_m);
  fix.speed = MetersPerSecond{speed_mps};
  static_cast<void>(situation.navigation.take(fix.time, fix, true));
  situation.track.take(fix);
}

void command(Situation& situation, double heading_rad, double depth_m) {
  situation.commanded =
      messages::Setpoint{.heading = Radians{heading_rad}, .speed = MetersPerSecond{2}, .depth = Meters{depth_m}, .waypoint = {}};
}

void give_status(Situation& situation, double altitude_m, double battery_percent, bool leak = false, bool ground_fault = false) {
  situation.vehicle = messages::VehicleStatus{.time = situation.now,
                                              .altitude = Meters{altitude_m},
                                              .battery_percent = battery_percent,
                                              .has_leak = leak,
                                              .has_ground_fault = ground_fault};
}

void sail_km(Situation& situation, int km) {
  Time time = ago(situation, 1000);
  place(situation, fix_at(time, at(0, 0)));
  for (int i = 1; i <= 10 * km; ++i) {
    time = time + Duration::seconds(1);
    situation.track.take(fix_at(time, at(100.0 * i, 0)));
  }
}

void stay_frozen(Situation& situation, int seconds) {
  place(situation, fix_at(ago(situation, seconds), at(5000, 5000)));
  for (int i = seconds - 1; i >= 0; --i)
    static_cast<void>(situation.navigation.take(ago(situation, i), fix_at(ago(situation, i), at(5000, 5000)), true));
}

void see_strange_fix(Situation& situation, std::int64_t seconds_ago) {
  place(situation, fix_at(ago(situation, seconds_ago + 1), at(5000, 5000)));
  static_cast<void>(situation.navigation.take(ago(situation, seconds_ago), fix_at(ago(situation, seconds_ago), at(9000, 5000)), true));
}

/// The fix is by half a second older than the newest, and arrives later.
void see_late_fix(Situation& situation, std::int64_t seconds_ago, double off_m) {
  const Time arrival = ago(situation, seconds_ago);
  place(situation, fix_at(arrival, at(5000, 5000)));
  const messages::Navigation late = fix_at(arrival + Duration::milliseconds(-500), at(5000 + off_m, 5000));
  EXPECT_FALSE(situation.navigation.take(arrival, late, true));
}

/// Northwards for a minute, at 2 m/s by what the fixes say.
void drift(Situation& situation, double way_m) {
  const messages::Setpoint told{.heading = {}, .speed = MetersPerSecond{2}, .depth = Meters{300}, .waypoint = {}};
  situation.place.begin(fix_at(ago(situation, 60), at(5000, 5000)));
  for (int s = 1; s <= 60; ++s)
    situation.place.take(fix_at(ago(situation, 60 - s), at(5000 + way_m / 60.0 * s, 5000)), told, fenced_mission().safety.vehicle);
}

void give_depths(Situation& situation, double then_m) {
  const config::VehicleLimits vehicle = fenced_mission().safety.vehicle;
  situation.depth.take(fix_at(situation.now, at(5000, 5000)));
  situation.depth.note_order(situation.now, {.heading = {}, .speed = MetersPerSecond{2}, .depth = Meters{300}, .waypoint = {}}, vehicle);
  situation.depth.take(fix_at(situation.now, at(5000, 5000), 0.0, then_m));
}

void go_nowhere_for(Situation& situation, std::int64_t seconds) {
  place(situation, fix_at(ago(situation, seconds), at(5000, 5000)));
  situation.track.set_waypoint(at(6000, 5000));
}

// In the order of Condition. Each lasts three seconds more.
const std::array<Scenario, config::kConditions> kScenarios{{
    {Condition::kNavigationAge,
     10.0,
     {"the newest fix is 12 s old", [](Situation& s) { place(s, fix_at(ago(s, 12), at(5000, 5000))); }},
     {"it is 5 s old", [](Situation& s) { place(s, fix_at(ago(s, 5), at(5000, 5000))); }}},
    {Condition::kNavigationJump,
     100.0,
     {"a fix 4 km off was refused this second, and goes on to be", [](Situation& s) { see_strange_fix(s, -3); }},
     {"one was refused 10 s ago", [](Situation& s) { see_strange_fix(s, 10); }}},
    {Condition::kNavigationFrozen,
     5.0,
     {"fixes have given one place for 8 s", [](Situation& s) { stay_frozen(s, 8); }},
     {"for 4 s", [](Situation& s) { stay_frozen(s, 4); }}},
    {Condition::kSnrAge,
     10.0,
     {"the newest SNR is 12 s old", [](Situation& s) { s.snr = ago(s, 12); }},
     {"it is 5 s old", [](Situation& s) { s.snr = ago(s, 5); }}},
    {Condition::kVehicleStatusAge,
     30.0,
     {"no status came in the 40 s since the search began", [](Situation& s) { s.search_began = ago(s, 40); }},
     {"one came 20 s ago",
      [](Situation& s) {
        s.search_began = ago(s, 40);
        s.vehicle = messages::VehicleStatus{.time = ago(s, 20)};
      }}},
    {Condition::kAutopilotAge,
     5.0,
     {"the autopilot was silent for 6 s", [](Situation& s) { s.autopilot = messages::AutopilotStatus{.time = ago(s, 6)}; }},
     {"it spoke 1 s ago", [](Situation& s) { s.autopilot = messages::AutopilotStatus{.time = ago(s, 1)}; }}},
    {Condition::kOperatorAge,
     60.0,
     {"no operator was heard for 61 s", [](Situation& s) { s.operator_heard = ago(s, 61); }},
     {"one was heard 50 s ago", [](Situation& s) { s.operator_heard = ago(s, 50); }}},
    {Condition::kOutsideFence,
     0.0,
     {"10 m before the save polygon's edge, straight at it", [](Situation& s) { place(s, fix_at(s.now, at(10'090, 5000))); }},
     {"the same, on the way in", [](Situation& s) { place(s, fix_at(s.now, at(10'090, 5000), 3.141592653589793)); }}},
    {Condition::kOutsideHalt,
     0.0,
     {"1 m beyond the halt polygon", [](Situation& s) { place(s, fix_at(s.now, at(10'301, 5000))); }},
     {"1 m within", [](Situation& s) { place(s, fix_at(s.now, at(10'299, 5000))); }}},
    {Condition::kDepth,
     320.0,
     {"316 m deep and sinking at 4 m/s", [](Situation& s) { move(s, at(5000, 5000), at(5008, 5000), 0.0, 16.0); }},
     {"316 m deep and level", [](Situation& s) { place(s, fix_at(s.now, at(5000, 5000), 0.0, 316.0)); }}},
    {Condition::kAltitude,
     10.0,
     {"8 m above the sea floor", [](Situation& s) { give_status(s, 8.0, 50.0); }},
     {"12 m above it", [](Situation& s) { give_status(s, 12.0, 50.0); }}},
    {Condition::kSpeed,
     2.5,
     {"3 m/s through the water", [](Situation& s) { move(s, at(5000, 5000), at(5008, 5000), 0.0, 0.0, 3.0); }},
     {"2 m/s", [](Situation& s) { move(s, at(5000, 5000), at(5008, 5000)); }}},
    {Condition::kTurnRate,
     10.0,
     {"a turn of 1 rad in 4 s", [](Situation& s) { move(s, at(5000, 5000), at(5008, 5000), 1.0); }},
     {"of 0.5 rad", [](Situation& s) { move(s, at(5000, 5000), at(5008, 5000), 0.5); }}},
    {Condition::kSearchTime,
     600.0,
     {"the search is 601 s old", [](Situation& s) { s.search_began = ago(s, 601); }},
     {"596 s", [](Situation& s) { s.search_began = ago(s, 596); }}},
    {Condition::kDistanceTravelled,
     4500.0,
     {"5 km were sailed", [](Situation& s) { sail_km(s, 5); }},
     {"4 km", [](Situation& s) { sail_km(s, 4); }}},
    {Condition::kBattery,
     20.0,
     {"19 % are left", [](Situation& s) { give_status(s, 100.0, 19.0); }},
     {"21 %", [](Situation& s) { give_status(s, 100.0, 21.0); }}},
    {Condition::kBatteryAtHome,
     20.0,
     {"27 % are left, 3 km from the safe point (4 km against the current) at 2 % a kilometre",
      [](Situation& s) {
        place(s, fix_at(s.now, at(5000, 8000)));
        give_status(s, 100.0, 27.0);
      }},
     {"29 %",
      [](Situation& s) {
        place(s, fix_at(s.now, at(5000, 8000)));
        give_status(s, 100.0, 29.0);
      }}},
    {Condition::kLeak,
     0.0,
     {"the vehicle reports that there is water in its hull", [](Situation& s) { give_status(s, 100.0, 50.0, true); }},
     {"it reports that there is none", [](Situation& s) { give_status(s, 100.0, 50.0, false, true); }}},
    {Condition::kGroundFault,
     0.0,
     {"the vehicle reports a ground fault", [](Situation& s) { give_status(s, 100.0, 50.0, false, true); }},
     {"of none", [](Situation& s) { give_status(s, 100.0, 50.0, true, false); }}},
    {Condition::kHydrophoneDeaf,
     0.0,
     {"the hydrophone reports that it is deaf",
      [](Situation& s) { s.hydrophone = messages::HydrophoneStatus{.time = s.now, .is_deaf = true}; }},
     {"that it hears", [](Situation& s) { s.hydrophone = messages::HydrophoneStatus{.time = s.now, .is_deaf = false}; }}},
    {Condition::kAutopilotDisengaged,
     0.0,
     {"the autopilot reports that it follows nobody",
      [](Situation& s) { s.autopilot = messages::AutopilotStatus{.time = s.now, .follows_setpoints = false}; }},
     {"that it follows", [](Situation& s) { s.autopilot = messages::AutopilotStatus{.time = s.now, .follows_setpoints = true}; }}},
    {Condition::kHeadingIgnored,
     20.0,
     {"it points 0.4 rad from its set-point", [](Situation& s) { command(s, 0.4, 300.0); }},
     {"0.3 rad", [](Situation& s) { command(s, -0.3, 300.0); }}},
    {Condition::kDepthIgnored,
     10.0,
     {"it is 12 m above its set-point", [](Situation& s) { command(s, 0.0, 312.0); }},
     {"8 m below", [](Situation& s) { command(s, 0.0, 292.0); }}},
    {Condition::kNoProgress,
     600.0,
     {"it came no nearer to its way-point for 601 s", [](Situation& s) { go_nowhere_for(s, 601); }},
     {"for 590 s", [](Situation& s) { go_nowhere_for(s, 590); }}},
    {Condition::kPolicyUnhealthy,
     0.0,
     {"the policy gave no number", [](Situation& s) { s.is_policy_unhealthy = true; }},
     {"it gave one", [](Situation& s) { s.is_policy_unhealthy = false; }}},
    {Condition::kNavigationDisputed,
     100.0,
     {"a fix from half a second before the newest lies 4 km off, and others go on to", [](Situation& s) { see_late_fix(s, -3, 4000.0); }},
     {"it lies 20 m off", [](Situation& s) { see_late_fix(s, -3, 20.0); }}},
    {Condition::kPlaceUnexplained,
     100.0,
     {"at 2 m/s the place moved by 400 m in a minute", [](Situation& s) { drift(s, 400.0); }},
     {"by 200 m", [](Situation& s) { drift(s, 200.0); }}},
    {Condition::kDepthUnexplained,
     20.0,
     {"it reads 250 m, and was ordered to 300 m when it read 300 m", [](Situation& s) { give_depths(s, 250.0); }},
     {"it reads 260 m", [](Situation& s) { give_depths(s, 260.0); }}},
    {Condition::kSetpointsUnsent,
     10.0,
     {"no set-point could be sent for 12 s", [](Situation& s) { s.mute_since = ago(s, 12); }},
     {"for 5 s", [](Situation& s) { s.mute_since = ago(s, 5); }}},
}};

/// The seconds after which the scenario's rule began to act; -1: it did not in three seconds.
int acts_after(const Scenario& scenario, const Case& what) {
  config::Mission mission = fenced_mission();
  const std::size_t own = standing_rules(mission);
  EXPECT_EQ(mission.safety.rules.push_back({.condition = scenario.condition,
                                            .limit = scenario.limit,
                                            .persistence = kPersistence,
                                            .response = config::Response::kWarn,
                                            .is_latched = false}),
            Status::kOk);
  Supervisor supervisor;
  supervisor.configure(mission);
  Situation situation = well(mission);
  situation.now = situation.now + Duration::seconds(2000);
  situation.search_began = situation.now;
  situation.snr = situation.now;
  place(situation, fix_at(situation.now, at(5000, 5000)));
  what.arrange(situation);
  for (int second = 0; second <= 3; ++second) {
    for (const messages::SafetyEvent& event : supervisor.watch(mission, situation)) {
      if (event.rule == own && event.begins) return second;
    }
    situation.now = situation.now + Duration::seconds(1);
  }
  return -1;
}

TEST(EveryRule, FiresInItsScenarioOnceItHasLastedAndRestsInTheOther) {
  for (std::size_t i = 0; i < kScenarios.size(); ++i) {
    const Scenario& scenario = kScenarios[i];
    ASSERT_EQ(static_cast<std::size_t>(scenario.condition), i) << "one for each, in their order";
    EXPECT_EQ(acts_after(scenario, scenario.fires), 2) << config::kConditionTraits[i].key;
    EXPECT_EQ(acts_after(scenario, scenario.rests), -1) << config::kConditionTraits[i].key;
  }
}

std::string table() {
  std::ostringstream text;
  text << "| condition | acts when | of a limit of | fires when | rests when |\n|---|---|---|---|---|\n";
  for (const Scenario& scenario : kScenarios) {
    const ConditionTraits& traits = config::kConditionTraits.at(static_cast<std::size_t>(scenario.condition));
    const bool is_flag = traits.kind == ConditionTraits::Kind::kFlag;
    const char* const side = traits.kind == ConditionTraits::Kind::kAbove ? " is above" : " is below";
    text << "| `" << traits.key << "` | " << traits.meaning << (is_flag ? "" : side) << " | ";
    if (!is_flag) text << scenario.limit;
    text << " | " << scenario.fires.words << " | " << scenario.rests.words << " |\n";
  }
  return text.str();
}

TEST(EveryRule, StandsInTheReadmesTableWithItsScenarios) {
  std::ifstream stream(std::string(EARSHOT_SOURCE_DIR) + "/firmware/safety/README.md");
  const std::string readme{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_NE(readme.find(table()), std::string::npos) << "the table in firmware/safety/README.md must be\n" << table();
}

}  // namespace
}  // namespace earshot::safety
