#include "firmware/desk/checklist/rule_warnings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "firmware/host/mission/mission_file.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

using config::Condition;
using config::Response;
using Lines = std::vector<std::string>;

/// At 300 m and 2 m/s, 100 steps of 1 km; turns in 25 m; 0.6 % of the battery a kilometre. With a fence 10 rules stand.
config::Mission mission_with(const std::vector<config::Rule>& rules) {
  config::Mission mission =
      host::load_mission(std::string(EARSHOT_SOURCE_DIR) + "/firmware/boards/linux/missions/fenced_search.toml").mission;
  mission.safety.rules.clear();
  for (const config::Rule& own : rules) (void)mission.safety.rules.push_back(own);
  return mission;
}

config::Rule rule(Condition condition, double limit, Response response, Duration lasting = {}) {
  return {.condition = condition, .limit = limit, .persistence = lasting, .response = response, .is_latched = response >= Response::kAbort};
}

/// Of a rule that aborts, in a mission where somebody watches the vehicle's status.
std::string warning_of(Condition condition, double limit, Duration lasting = {}) {
  const Lines warnings = rule_warnings(
      mission_with({rule(Condition::kVehicleStatusAge, 60, Response::kWarn), rule(condition, limit, Response::kAbort, lasting)}));
  EXPECT_LE(warnings.size(), 1U);
  return warnings.empty() ? "" : warnings[0];
}

TEST(RuleWarnings, AreNoneAboutTheMissionThatShips) {
  const auto file = host::load_mission(std::string(EARSHOT_SOURCE_DIR) + "/firmware/boards/linux/missions/fenced_search.toml");
  EXPECT_EQ(rule_warnings(file.mission), Lines{});
}

TEST(RuleWarnings, NameARuleThatActsInEverySearch) {
  const std::string acts = ") acts in a search that goes as it is planned: ";
  EXPECT_EQ(warning_of(Condition::kDepth, 100),
            "rule 16 (abort once the vehicle's depth is above 100 m (depth_m)" + acts + "the search is at 300 m; leave 2 m");
  EXPECT_NE(warning_of(Condition::kDepth, 301), "");
  EXPECT_EQ(warning_of(Condition::kDepth, 302), "");
  EXPECT_EQ(warning_of(Condition::kSpeed, 1.5),
            "rule 16 (abort once the speed through the water is above 1.5 m/s (speed_mps)" + acts + "the search is at 2 m/s");
  EXPECT_NE(warning_of(Condition::kSpeed, 2.0), "");
  EXPECT_EQ(warning_of(Condition::kSpeed, 2.5), "");
  EXPECT_EQ(warning_of(Condition::kDistanceTravelled, 1000),
            "rule 16 (abort once the distance travelled is above 1000 m (distance_m)" + acts + "all steps are 100000 m");
  EXPECT_EQ(warning_of(Condition::kDistanceTravelled, 100'000), "");
  EXPECT_EQ(warning_of(Condition::kSearchTime, 49'999),
            "rule 16 (abort once the time since the search began is above 49999 s (search_time_s)" + acts +
                "all steps take 50000 s in still water");
  EXPECT_EQ(warning_of(Condition::kSearchTime, 50'000), "");
}

// 2 m/s round a circle of 25 m: 0.08 rad/s, 4.58 degrees a second; half of it, less 60 degrees, in 26.2 s.
TEST(RuleWarnings, NameARuleThatTheVehiclesOwnTurnsAndDivesBreak) {
  const std::string acts = ") acts in a search that goes as it is planned: ";
  EXPECT_TRUE(support::tells(warning_of(Condition::kTurnRate, 4.5), {"rule 16", "rate of turn", "above 4.5", "turn_rate_deg_per_s", acts,
                                                                     "vehicle's", "tightest", "4.6 degrees"}));
  EXPECT_EQ(warning_of(Condition::kTurnRate, 4.6), "");
  EXPECT_TRUE(support::tells(warning_of(Condition::kHeadingIgnored, 60, Duration::seconds(26)),
                             {"rule 16", "above 60", "26 s", "heading_ignored_deg", acts, "round", "vehicle", "up", "26 s"}));
  EXPECT_EQ(warning_of(Condition::kHeadingIgnored, 60, Duration::seconds(27)), "");
  // Straight down at 3 m/s: 285 m in 95 s.
  EXPECT_TRUE(support::tells(warning_of(Condition::kDepthIgnored, 15, Duration::seconds(94)),
                             {"rule 16", "above 15", "94 s", "depth_ignored_m", acts, "surface", "300 m", "95 s", "at least"}));
  EXPECT_EQ(warning_of(Condition::kDepthIgnored, 15, Duration::seconds(95)), "");
}

// All steps: 60 %. Home from (25, 25) km to (2, 3) km: 31.83 km, against 0.4 m/s 39.79 km, 23.9 %.
TEST(RuleWarnings, CountTheReserveThatARuleKeeps) {
  const std::string acts = ") acts in a search that goes as it is planned: all steps need 60 % of a battery";
  EXPECT_TRUE(support::tells(warning_of(Condition::kBatteryAtHome, 95),
                             {"rule 16", "below 95", "battery_at_home_percent", acts, "home 24 %", "95 %"}));
  EXPECT_NE(warning_of(Condition::kBatteryAtHome, 16.2), "");
  EXPECT_EQ(warning_of(Condition::kBatteryAtHome, 16.0), "");
  EXPECT_EQ(warning_of(Condition::kBattery, 41),
            "rule 16 (abort once the battery's charge is below 41 % (battery_percent)" + acts + ", and the rule keeps 41 %");
  EXPECT_EQ(warning_of(Condition::kBattery, 40), "");
}

TEST(RuleWarnings, NameTheRulesThatGoByTheWordOfWhomNobodyWatches) {
  const config::Rule leak = rule(Condition::kLeak, 0, Response::kRelease);
  const config::Rule altitude = rule(Condition::kAltitude, 15, Response::kSurface);
  const config::Rule disengaged = rule(Condition::kAutopilotDisengaged, 0, Response::kAbort);
  EXPECT_TRUE(support::lines_tell(rule_warnings(mission_with({leak, disengaged, altitude})),
                                  {{"no", "age of the newest vehicle status (vehicle_status_age_s)", "nobody", "any", "15", "17", "none"},
                                   {"no", "age of the newest autopilot status (autopilot_age_s)", "nobody", "any", "rule 16", "none"}}));
  const config::Rule status_age = rule(Condition::kVehicleStatusAge, 60, Response::kWarn);
  const config::Rule autopilot_age = rule(Condition::kAutopilotAge, 10, Response::kWarn);
  EXPECT_EQ(rule_warnings(mission_with({leak, disengaged, altitude, status_age, autopilot_age})), Lines{});
}

}  // namespace
}  // namespace earshot::board
