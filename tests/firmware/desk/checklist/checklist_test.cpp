#include "firmware/desk/checklist/checklist.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/support/signed_policy.hpp"
#include "tests/support/text/tells.hpp"
#include "tests/support/three_oceans.hpp"

namespace earshot::board {
namespace {

const std::string kMissions = std::string(EARSHOT_SOURCE_DIR) + "/firmware/boards/linux/missions/";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A policy that needs no ocean tables.
host::SignedSearch walk() {
  host::SignedSearch with;
  with.policy.policy = std::make_unique<policy::FrozenPolicy>(support::random_walk_policy());
  return with;
}

TEST(Checklist, TellsPortsSearchBudgetsAndRules) {
  const host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  const std::string text = checklist(file, walk(), "there/fenced_search.toml", {});
  EXPECT_TRUE(has(text, "  mission     there/fenced_search.toml\n")) << text;
  EXPECT_TRUE(support::has_line(text, {"LCM", "udpm://239.255.76.67:7667?ttl=0"})) << text;
  EXPECT_TRUE(support::has_line(text, {"25.0 km", "25.0 km", "250 m"})) << text;
  EXPECT_TRUE(support::has_line(text, {"300.0 m", "never below 400.0 m"})) << text;
  EXPECT_TRUE(has(text, "  set-points  every 1 s\n")) << text;
  // 100 km at 2 m/s are 50 000 s, at 1.6 m/s over ground 62 500 s; 70 000 s are 19 h 27 min. Home from (25, 25) km to (2, 3) km: 31.83 km;
  // against 0.4 m/s that is 39.79 km through the water, at 0.6 % a kilometre 23.9 %.
  EXPECT_TRUE(support::has_line(text, {"13 h", "53 min", "17 h", "22 min", "after 19 h", "27 min"})) << text;
  EXPECT_TRUE(support::has_line(text, {"100.0 km", "31.8 km", "home"})) << text;
  EXPECT_TRUE(support::has_line(text, {"60.0 %", "23.9 %", "home"})) << text;
  EXPECT_TRUE(has(text, "rules (the first 14 stand")) << text;
  EXPECT_TRUE(support::has_line(text, {"1", "abort once", "newest", "above 5 s"})) << text;
  EXPECT_TRUE(support::has_line(text, {"17", "abort", "once", "2 s"})) << text;
}

TEST(Checklist, TellsThatArrivalsMakeTurns) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  file.turns = host::Turns::kOnArrival;
  const std::string text = checklist(file, walk(), "fenced_search.toml", {});
  EXPECT_TRUE(support::has_line(text, {"once", "at most 500", "1 s"})) << text;
}

TEST(Checklist, TellsWhoSignedWhatWillBeFlown) {
  const host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  const auto told = [&file](const Signatures& signatures) { return checklist(file, walk(), "m.toml", signatures); };
  const std::string by_both = told({.policy = "keys/../training.pub", .tables = {}, .mission = "keys/../ops.pub", .counter = 7});
  EXPECT_TRUE(has(by_both, "  mission     m.toml\n  signed by   ops.pub, ")) << by_both;
  EXPECT_TRUE(support::has_line(by_both, {"signed", "ops.pub", "counter 7"})) << by_both;
  EXPECT_TRUE(has(by_both, " numbers\n  signed by   training.pub\n")) << by_both;
  const std::string by_one = told({.policy = "training.pub", .tables = {}, .mission = {}});
  EXPECT_TRUE(has(by_one, "  mission     m.toml\n  signed by   nobody")) << by_one;
}

TEST(Checklist, TellsTheOceansThatAPolicySearchesBy) {
  const host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  EXPECT_TRUE(support::has_line(checklist(file, walk(), "m.toml", {}), {"tables", "none"}));
  host::SignedSearch with = walk();
  with.tables_file = "there/../20hz.tables";
  with.tables.tables = support::three_oceans({Meters{12'700}, Meters{12'700}});
  const std::string text = checklist(file, with, "m.toml", {.policy = {}, .tables = "keys/../ours.pub", .mission = {}});
  // 127 steps of 200 m
  EXPECT_TRUE(support::has_line(text, {"tables", "20hz.tables", "20 Hz", "300 m", "3 oceans", "25.4 km"})) << text;
  EXPECT_TRUE(has(text, " 25.4 km\n  signed by   ours.pub\n")) << text;
}

TEST(Checklist, TellsWhoMayCommandTheVehicle) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  const auto told = [&file] { return checklist(file, walk(), "", {}); };
  EXPECT_TRUE(has(told(), "  orders      of anybody on the bus\n")) << told();
  EXPECT_TRUE(support::has_line(told(), {"START", "no autopilot's", "status"}));
  file.command_key = host::CommandKey(host::KeyBytes{1});
  file.command_key_file = "keys/../vehicle.key";
  file.mission.authority.autopilot_timeout = Duration::milliseconds(2500);
  EXPECT_TRUE(support::has_line(told(), {"without", "vehicle_id", "vehicle.key", "ABORT"})) << told();
  file.challenge = host::new_challenge("auv-7", {});
  EXPECT_TRUE(support::has_line(told(), {"auv-7", "vehicle.key", "ABORT"})) << told();
  file.accepts_old_marks = true;
  EXPECT_TRUE(support::has_line(told(), {"ABORT", "anybody", "marks", "without", "challenge", "too"})) << told();
  EXPECT_TRUE(support::has_line(told(), {"START", "no", "2.5 s"}));
}

TEST(Checklist, TellsWhatTheVehicleCan) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  const std::string text = checklist(file, walk(), "", {});
  EXPECT_TRUE(support::has_line(text, {"at most 3.00 m/s", "at most 0.40 m/s"})) << text;
  EXPECT_TRUE(has(text, "  turns       within a radius of 25 m\n"));
  EXPECT_TRUE(support::has_line(text, {"holds", "place", "1.00 m/s"}));
  // 400 m at 0.1 m/s are 4000 s, and a minute to turn up: 67.7 min.
  EXPECT_TRUE(support::has_line(text, {"up", "1.00 m/s", "at least 0.10 m/s", "up", "2.0 m", "less", "400 m", "within 1 h", "08 min"}))
      << text;
  file.mission.safety.vehicle = {};
  const std::string other = checklist(file, walk(), "", {});
  EXPECT_TRUE(has(other, "  holds       hovers\n")) << other;
  EXPECT_TRUE(has(other, "  comes up    floats up by itself\n"));
}

TEST(Checklist, TellsFenceSafePointAndZonesAndWhatSurfaceWaitsFor) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  const std::string text = checklist(file, walk(), "", {});
  EXPECT_TRUE(support::has_line(text, {"5 corners", "-2000 to 29600 m north", "-2000 to 27000 m east"})) << text;
  EXPECT_TRUE(support::has_line(text, {"2000 m north", "3000 m east"}));
  EXPECT_TRUE(support::has_line(text, {"no surface", "4 corners", "6000 to 19000 m north", "-1500 to 26500 m east"}));
  const std::string surface = "surface once the height above the sea floor is below 15 m for 2 s (altitude_m)";
  EXPECT_TRUE(support::has_line(text, {surface, "zone of no_surface", "leaves"}));
  file.mission.safety.no_surface.clear();
  file.mission.safety.fence.reset();
  const std::string other = checklist(file, walk(), "", {});
  EXPECT_TRUE(has(other, surface + "\n")) << other;
  EXPECT_TRUE(support::has_line(other, {"fence", "none", "search", "aborted beyond", "area"}));
}

TEST(Checklist, KeepsTheWholeNameOfAPortApartFromItsAddress) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  for (const std::string& name : {std::string("twelve chars"), std::string(300, 'n')}) {
    file.ports.at(0).name = name;
    EXPECT_TRUE(has(checklist(file, walk(), "", {}), "  " + name + " LCM udpm://"));
  }
}

TEST(Checklist, SaysThatEnergyIsNotKnown) {
  const host::MissionFile file = host::load_mission(kMissions + "search.toml");
  EXPECT_TRUE(support::has_line(checklist(file, walk(), "", {}), {"not known", "vehicle.battery_percent_per_km"}));
}

}  // namespace
}  // namespace earshot::board
