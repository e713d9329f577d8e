#include "firmware/host/mission/safety_table.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "firmware/host/mission/mission_file.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

const std::filesystem::path kShipped = std::filesystem::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions/fixed_source.toml";

/// 25 km x 25 km at 2 m/s, as the shipped mission has them.
const std::string kTables = R"([vehicle]
max_speed_mps = 3.0
max_current_mps = 0.5
turn_radius_m = 20.0
hold_speed_mps = 1.0
ascent_speed_mps = 1.5
ascent_rate_mps = 0.3
surface_depth_m = 0.8
battery_percent_per_km = 0.6

[fence]
inside_north_m = [0, 25000, 25000, 0]
inside_east_m = [0, 0, 25000, 25000]
save_north_m = [-100, 25100, 25100, -100]
save_east_m = [-100, -100, 25100, 25100]
halt_north_m = [-300, 25300, 25300, -300]
halt_east_m = [-300, -300, 25300, 25300]

[safe_point]
north_m = 1000.0
east_m = 2000.0

[[no_surface]]
north_m = [5000, 6000, 6000]
east_m = [5000, 5000, 6000]

[[rule]]
when = "battery_percent"
below = 15.0
for_s = 10.0
then = "return"
latched = true

[[rule]]
when = "leak"
then = "release"

)";

std::string mission_with(const std::string& tables) {
  std::ifstream stream(kShipped);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  text.insert(text.find("[origin]"), tables);
  return text;
}

MissionFile mission_of(const std::string& tables) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "mission.toml") << mission_with(tables);
  return load_mission(folder / "mission.toml");
}

/// What is said, from the key on.
std::string complaint(const std::string& from, const std::string& to) {
  std::string tables = kTables;
  const std::size_t at = tables.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  tables.replace(at, from.size(), to);
  try {
    (void)mission_of(tables);
  } catch (const BadInput& e) {
    const std::string what = e.what();
    return what.substr(what.find(": ") + 2);
  }
  return {};
}

TEST(SafetyTable, GivesEveryKey) {
  const config::Safety safety = mission_of(kTables).mission.safety;
  EXPECT_EQ(safety.vehicle, (config::VehicleLimits{.max_speed = MetersPerSecond{3.0},
                                                   .max_current = MetersPerSecond{0.5},
                                                   .turn_radius = Meters{20.0},
                                                   .hold_speed = MetersPerSecond{1.0},
                                                   .ascent_speed = MetersPerSecond{1.5},
                                                   .ascent_rate = MetersPerSecond{0.3},
                                                   .surface_depth = Meters{0.8},
                                                   .battery_percent_per_km = 0.6}));
  ASSERT_TRUE(safety.fence);
  EXPECT_EQ(safety.fence->inside.size(), 4U);
  EXPECT_EQ(safety.fence->save[1], (NorthEast{.north = Meters{25'100}, .east = Meters{-100}}));
  EXPECT_EQ(safety.fence->halt[3], (NorthEast{.north = Meters{-300}, .east = Meters{25'300}}));
  EXPECT_EQ(safety.safe_point, (NorthEast{.north = Meters{1000}, .east = Meters{2000}}));
  ASSERT_EQ(safety.no_surface.size(), 1U);
  EXPECT_EQ(safety.no_surface[0][2], (NorthEast{.north = Meters{6000}, .east = Meters{6000}}));
  ASSERT_EQ(safety.rules.size(), 2U);
  EXPECT_EQ(safety.rules[0], (config::Rule{.condition = config::Condition::kBattery,
                                           .limit = 15.0,
                                           .persistence = Duration::seconds(10),
                                           .response = config::Response::kReturn,
                                           .is_latched = true}));
  EXPECT_EQ(safety.rules[1], (config::Rule{.condition = config::Condition::kLeak,
                                           .limit = 0.0,
                                           .persistence = {},
                                           .response = config::Response::kRelease,
                                           .is_latched = true}));
}

TEST(SafetyTable, MayBeLeftOut) {
  const config::Safety safety = mission_of("").mission.safety;
  EXPECT_EQ(safety, config::Safety{});
}

// A key that was changed may be the other one: its line is named, too. The search's speed, 2 m/s, stands in the file's line 16.
TEST(SafetyTable, NamesBothKeysThatDoNotFitEachOther) {
  const std::string said = complaint("max_current_mps = 0.5", "max_current_mps = 2.4");
  EXPECT_TRUE(said.starts_with("vehicle.max_current_mps = 2.4: ")) << said << " (as short as it was written)";
  EXPECT_TRUE(said.ends_with("/mission.toml:16: search.speed_mps = 2)")) << said;
  EXPECT_NE(complaint("max_speed_mps = 3.0", "max_speed_mps = 1.9").find("vehicle.max_speed_mps = 1.9: "), std::string::npos);
  const std::string ascent = complaint("ascent_speed_mps = 1.5", "ascent_speed_mps = 3.1");
  EXPECT_NE(ascent.find(": vehicle.max_speed_mps = 3)"), std::string::npos) << ascent;
}

TEST(SafetyTable, RefusesAVehicleThatRisesFasterThanItMoves) {
  const std::string said = complaint("ascent_rate_mps = 0.3", "ascent_rate_mps = 5.0");
  EXPECT_TRUE(support::tells(said, {"vehicle.ascent_rate_mps", "5.0", "at most vehicle.ascent_speed_mps", "1.5"})) << said;
  EXPECT_EQ(complaint("ascent_rate_mps = 0.3", "ascent_rate_mps = 1.5"), "");
  const std::string slow = complaint("ascent_speed_mps = 1.5\nascent_rate_mps = 0.3", "ascent_speed_mps = 0.05");
  EXPECT_TRUE(support::tells(slow, {"vehicle.ascent_speed_mps", "0.05", "0 or at least 0.1"})) << slow;
}

TEST(SafetyTable, NamesTheKeyAndWhatIsWrongWithIt) {
  EXPECT_EQ(complaint("max_current_mps = 0.5", "max_current_mps = 2.0").substr(0, 23), "vehicle.max_current_mps");
  EXPECT_EQ(complaint("hold_speed_mps = 1.0", "hold_speed_mps = 2.1").substr(0, 22), "vehicle.hold_speed_mps");
  EXPECT_EQ(complaint("ascent_speed_mps = 1.5", "ascent_speed_mps = 3.1").substr(0, 24), "vehicle.ascent_speed_mps");
  EXPECT_EQ(complaint("ascent_rate_mps = 0.3", "ascent_rate_mps = 0.09").substr(0, 23), "vehicle.ascent_rate_mps");
  EXPECT_EQ(complaint("surface_depth_m = 0.8", "surface_depth_m = 0").substr(0, 23), "vehicle.surface_depth_m");
  EXPECT_TRUE(
      support::has_line(complaint("inside_east_m = [0, 0, 25000, 25000]", "inside_east_m = [0, 0, 25000]"), {"many", "inside_north_m"}));
  EXPECT_TRUE(support::has_line(complaint("save_north_m = [-100, 25100, 25100, -100]", "save_north_m = [-100, 25100, -100, 25100]"),
                                {"itself", "after corner 2 meets", "after corner 4"}));
  // 2 m/s, 0.5 m/s, 20 m: 20 (1 + pi/8) + 20 (1 + pi/8 + 0.571 / 16) = 56.4 m; straight on for 8 s would be 48.6 m.
  EXPECT_TRUE(support::has_line(complaint("halt_north_m = [-300, 25300, 25300, -300]", "halt_north_m = [-110, 25300, 25300, -110]"),
                                {"polygon", "57 m", "edges"}));
  EXPECT_NE(
      complaint("inside_north_m = [0, 25000, 25000, 0]", "inside_north_m = [2000, 25000, 25000, 2000]").find("must hold every way-point"),
      std::string::npos);
  EXPECT_NE(complaint("north_m = 1000.0", "north_m = -1000.0").find("must lie inside the fence"), std::string::npos);
  EXPECT_NE(complaint("north_m = [5000, 6000, 6000]", "north_m = [5000, 5000, 6000]").find("corner 1 and the next are one place"),
            std::string::npos);
  EXPECT_NE(complaint("below = 15.0", "below = 101.0").find("[[rule]] number 1 of the file: below"), std::string::npos);
  EXPECT_TRUE(support::has_line(complaint("below = 15.0", "above = 15.0"), {"[[rule]]", "number 1", "file", "below", "missing"}));
  EXPECT_NE(complaint("when = \"leak\"", "when = \"leaks\"").find("[[rule]] number 2 of the file: when"), std::string::npos);
  EXPECT_NE(complaint("then = \"return\"", "then = \"go home\"").find("[[rule]] number 1 of the file: then"), std::string::npos);
}

TEST(SafetyTable, TakesABatteryThatLastsForEverForOneThatIsNotSpokenOf) {
  EXPECT_EQ(mission_of("[vehicle]\nmax_speed_mps = 3.0\n").mission.safety.vehicle.battery_percent_per_km, 0.0);
  EXPECT_EQ(complaint("battery_percent_per_km = 0.6", "battery_percent_per_km = 0.0"), "");
  EXPECT_NE(complaint("battery_percent_per_km = 0.6", "battery_percent_per_km = -0.1").find("vehicle.battery_percent_per_km"),
            std::string::npos);
}

TEST(SafetyTable, HasRoomForFourZonesAndSaysSo) {
  std::string zones;
  for (int i = 0; i < 4; ++i) zones += "[[no_surface]]\nnorth_m = [5000, 6000, 6000]\neast_m = [5000, 5000, 6000]\n\n";
  EXPECT_TRUE(support::tells(complaint("[[no_surface]]", zones + "[[no_surface]]"), {"no_surface", "5 tables", "at most 4"}));
}

TEST(SafetyTable, HasRoomForTwentyFiveRulesAndSaysSoInOneLine) {
  std::string rules;
  for (int i = 0; i < 25'000; ++i) rules += "[[rule]]\nwhen = \"leak\"\nthen = \"release\"\n\n";
  const std::string said = complaint("[[no_surface]]", rules + "[[no_surface]]");
  EXPECT_TRUE(support::has_line(said, {"rule", "25002 tables", "at most 25"})) << said;
  EXPECT_EQ(said.find("rule 26"), std::string::npos) << said;
}

TEST(SafetyTable, NamesTheMissionsOwnRuleThatLeavesAnotherNothingToDo) {
  const std::string what =
      complaint("when = \"leak\"\nthen = \"release\"", "when = \"battery_percent\"\nbelow = 14.0\nfor_s = 10.0\nthen = \"hold\"");
  EXPECT_TRUE(support::has_line(
      what, {"[[rule]]", "number 2", "file", "when", "battery_percent", "never", "anything", "sooner", "battery_percent", "below 15"}))
      << what;
  EXPECT_EQ(what.find("stands in every mission"), std::string::npos) << what;
}

TEST(SafetyTable, NamesTheRuleThatLeavesAnotherNothingToDo) {
  EXPECT_TRUE(support::tells(complaint("when = \"leak\"\nthen = \"release\"", "when = \"navigation_age_s\"\nabove = 9\nthen = \"hold\""),
                             {"[[rule]]", "number 2", "file", "when", "navigation_age_s", "never", "anything", "sooner", "navigation_age_s",
                              "above 5", "then abort"}));
}

}  // namespace
}  // namespace earshot::host
