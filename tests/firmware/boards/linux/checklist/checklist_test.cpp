#include "firmware/boards/linux/checklist/checklist.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/signed_policy.hpp"

namespace earshot::board {
namespace {

const std::string kMissions = std::string(EARSHOT_SOURCE_DIR) + "/firmware/boards/linux/missions/";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool is_doubted(const host::MissionFile& file, const std::string& part) {
  const std::vector<std::string> doubts = doubts_about(file);
  return std::ranges::any_of(doubts, [&part](const std::string& doubt) { return has(doubt, part); });
}

TEST(Checklist, TellsPortsSearchBudgetsAndRules) {
  const host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  const std::string text = checklist(file, support::random_walk_policy(), "there/fenced_search.toml");
  EXPECT_TRUE(has(text, "  mission     there/fenced_search.toml\n")) << text;
  EXPECT_TRUE(has(text, "  vehicle     LCM udpm://239.255.76.67:7667?ttl=0: navigation, snr, operator, autopilot, status\n")) << text;
  EXPECT_TRUE(has(text, "  area        25.0 km x 25.0 km, way-points 250 m from its edges\n")) << text;
  EXPECT_TRUE(has(text, "  depth       300.0 m, and never below 400.0 m\n")) << text;
  // 100 km at 2 m/s are 50 000 s; 60 000 s are 16 h 40 min. Home from (25, 25) km to (2, 3) km: 31.83 km; against 0.4 m/s that is
  // 39.79 km through the water, at 0.6 % a kilometre 23.9 %.
  EXPECT_TRUE(has(text, "13 h 53 min for all steps in still water; the search ends after 16 h 40 min\n")) << text;
  EXPECT_TRUE(has(text, "100.0 km for all steps, 31.8 km for the longest way home\n")) << text;
  EXPECT_TRUE(has(text, "60.0 % of the battery for all steps in still water, 23.9 % for the longest way home against the current\n"))
      << text;
  EXPECT_TRUE(has(text, "rules (the first 10 stand")) << text;
  EXPECT_TRUE(has(text, "   1  abort once the age of the newest fix is above 5 s\n")) << text;
  EXPECT_TRUE(has(text, "  13  abort and ask for the drop weight to be released once there is water in the hull for 2 s\n")) << text;
}

TEST(Checklist, DoubtsWhatIsAllowedAndUnwise) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  EXPECT_TRUE(is_doubted(file, "authority.key_file"));
  EXPECT_EQ(doubts_about(file).size(), 1U);
  file.command_key = host::CommandKey(host::KeyBytes{});
  EXPECT_TRUE(doubts_about(file).empty());
  file.mission.max_depth = file.mission.search_depth + Meters{2.0};
  EXPECT_TRUE(doubts_about(file).empty());
  file.mission.max_depth = file.mission.search_depth + Meters{1.5};
  EXPECT_TRUE(is_doubted(file, "search.depth_m is 1.5 m above limits.max_depth_m"));
  file.mission.max_time = Duration::seconds(49'999);
  EXPECT_TRUE(is_doubted(file, "limits.max_time_s is over before all steps are taken"));
  file.mission.safety.vehicle.battery_percent_per_km = 1.01;
  EXPECT_TRUE(is_doubted(file, "all steps need 101 % of a battery"));
  file.mission.safety.rules.clear();
  EXPECT_TRUE(is_doubted(file, "no rule watches the battery"));
  file.mission.safety.fence.reset();
  EXPECT_TRUE(is_doubted(file, "there is no [fence]"));
  file.mission.safety.vehicle = {};
  EXPECT_TRUE(is_doubted(file, "there is no [vehicle]"));
  file.ports.push_back({.name = "bus", .kind = host::PortKind::kCan, .address = "nosuchbus0", .roles = {}});
  EXPECT_TRUE(is_doubted(file, "this computer has no interface nosuchbus0 now"));
}

// Home from (25, 25) km to (2, 3) km: 31.83 km, against 0.4 m/s 39.79 km. At 0.9 % a kilometre the steps alone take 90 %, and with the way
// home 125.8 %.
TEST(Checklist, DoubtsABatteryThatLastsForTheSearchButNotForTheWayHome) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  file.mission.safety.vehicle.battery_percent_per_km = 0.9;
  EXPECT_TRUE(is_doubted(file, "all steps and the longest way home need 126 % of a battery"));
  file.mission.safety.safe_point.reset();
  EXPECT_FALSE(is_doubted(file, "of a battery"));
}

TEST(Checklist, DoubtsAChargeAtHomeThatCountsNoWay) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  file.mission.safety.vehicle.battery_percent_per_km = 0.0;
  EXPECT_TRUE(is_doubted(file, "battery_at_home_percent counts no way home"));
  file.mission.safety.rules.clear();
  EXPECT_FALSE(is_doubted(file, "counts no way home"));
}

TEST(Checklist, DoubtsARuleAboutADeafHydrophoneThatNoPortCanTellOf) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  EXPECT_FALSE(is_doubted(file, "hydrophone_deaf"));
  file.ports.at(0).roles.remove(host::Role::kSnr);
  EXPECT_TRUE(is_doubted(file, "no port has the role \"snr\", the only one that tells of hydrophone_deaf: the rule about it never acts"));
  file.mission.safety.rules.clear();
  EXPECT_FALSE(is_doubted(file, "hydrophone_deaf"));
}

TEST(Checklist, KeepsTheWholeNameOfAPortApartFromItsAddress) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  for (const std::string& name : {std::string("twelve chars"), std::string(300, 'n')}) {
    file.ports.at(0).name = name;
    EXPECT_TRUE(has(checklist(file, support::random_walk_policy(), ""), "  " + name + " LCM udpm://"));
  }
}

TEST(Checklist, SaysThatEnergyIsNotKnown) {
  const host::MissionFile file = host::load_mission(kMissions + "search.toml");
  EXPECT_TRUE(has(checklist(file, support::random_walk_policy(), ""), "not known: vehicle.battery_percent_per_km is not given"));
}

}  // namespace
}  // namespace earshot::board
