#include "firmware/desk/checklist/checklist.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/support/signed_policy.hpp"
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
  EXPECT_TRUE(has(text, "  vehicle     LCM udpm://239.255.76.67:7667?ttl=0: navigation, snr, operator, autopilot, status\n")) << text;
  EXPECT_TRUE(has(text, "  area        25.0 km x 25.0 km, way-points 250 m from its edges\n")) << text;
  EXPECT_TRUE(has(text, "  depth       300.0 m, and never below 400.0 m\n")) << text;
  EXPECT_TRUE(has(text, "  set-points  every 1 s\n")) << text;
  // 100 km at 2 m/s are 50 000 s, at 1.6 m/s over ground 62 500 s; 70 000 s are 19 h 27 min. Home from (25, 25) km to (2, 3) km: 31.83 km;
  // against 0.4 m/s that is 39.79 km through the water, at 0.6 % a kilometre 23.9 %.
  EXPECT_TRUE(
      has(text, "13 h 53 min for all steps in still water, 17 h 22 min against the current all along; the search ends after 19 h 27 min\n"))
      << text;
  EXPECT_TRUE(has(text, "100.0 km for all steps, 31.8 km for the longest way home\n")) << text;
  EXPECT_TRUE(has(text, "60.0 % of the battery for all steps in still water, 23.9 % for the longest way home against the current\n"))
      << text;
  EXPECT_TRUE(has(text, "rules (the first 14 stand")) << text;
  EXPECT_TRUE(has(text, "   1  abort once the age of the newest fix is above 5 s\n")) << text;
  EXPECT_TRUE(has(text, "  17  abort and ask for the drop weight to be released once there is water in the hull for 2 s\n")) << text;
}

TEST(Checklist, TellsThatArrivalsMakeTurns) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  file.turns = host::Turns::kOnArrival;
  const std::string text = checklist(file, walk(), "fenced_search.toml", {});
  EXPECT_TRUE(has(text, "  set-points  at once on every fix and order, at most 500 a second; in silence every 1 s\n")) << text;
}

TEST(Checklist, TellsWhoSignedWhatWillBeFlown) {
  const host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  const auto told = [&file](const Signatures& signatures) { return checklist(file, walk(), "m.toml", signatures); };
  const std::string by_both = told({.policy = "keys/../training.pub", .tables = {}, .mission = "keys/../ops.pub", .counter = 7});
  EXPECT_TRUE(has(by_both, "  mission     m.toml\n  signed by   ops.pub, counter 7\n  policy ")) << by_both;
  EXPECT_TRUE(has(by_both, " numbers\n  signed by   training.pub\n")) << by_both;
  const std::string by_one = told({.policy = "training.pub", .tables = {}, .mission = {}});
  EXPECT_TRUE(has(by_one, "  mission     m.toml\n  signed by   nobody; no signature is asked for\n  policy ")) << by_one;
}

TEST(Checklist, TellsTheOceansThatAPolicySearchesBy) {
  const host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  EXPECT_TRUE(has(checklist(file, walk(), "m.toml", {}), "  tables      none, the policy does not search by them\n"));
  host::SignedSearch with = walk();
  with.tables_file = "there/../20hz.tables";
  with.tables.tables = support::three_oceans({Meters{12'700}, Meters{12'700}});
  const std::string text = checklist(file, with, "m.toml", {.policy = {}, .tables = "keys/../ours.pub", .mission = {}});
  // 127 steps of 200 m
  EXPECT_TRUE(has(text, "  tables      20hz.tables: 20 Hz, the vehicle at 300 m, 3 oceans as far as 25.4 km\n  signed by   ours.pub\n"))
      << text;
}

TEST(Checklist, TellsWhoMayCommandTheVehicle) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  const auto told = [&file] { return checklist(file, walk(), "", {}); };
  EXPECT_TRUE(has(told(), "  orders      of anybody on the bus\n")) << told();
  EXPECT_TRUE(has(told(), "  START       waits for no autopilot's status\n"));
  file.command_key = host::CommandKey(host::KeyBytes{1});
  file.command_key_file = "keys/../vehicle.key";
  file.mission.authority.autopilot_timeout = Duration::milliseconds(2500);
  EXPECT_TRUE(has(told(),
                  "  orders      for a vehicle without a name (vehicle_id), with the mark of who knows the key in vehicle.key; ABORT of "
                  "anybody\n"))
      << told();
  file.challenge = host::new_challenge("auv-7", {});
  EXPECT_TRUE(has(told(), "  orders      for auv-7, with the mark of who knows the key in vehicle.key; ABORT of anybody\n")) << told();
  file.accepts_old_marks = true;
  EXPECT_TRUE(has(told(), "; ABORT of anybody; marks without the challenge count, too\n")) << told();
  EXPECT_TRUE(has(told(), "  START       waits for an autopilot's status no older than 2.5 s\n"));
}

TEST(Checklist, TellsWhatTheVehicleCan) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  const std::string text = checklist(file, walk(), "", {});
  EXPECT_TRUE(has(text, "  speed       at most 3.00 m/s through the water, in a current of at most 0.40 m/s\n")) << text;
  EXPECT_TRUE(has(text, "  turns       within a radius of 25 m\n"));
  EXPECT_TRUE(has(text, "  holds       its place by going round at 1.00 m/s\n"));
  // 400 m at 0.1 m/s are 4000 s, and a minute to turn up: 67.7 min.
  EXPECT_TRUE(has(text,
                  "  comes up    by going round at 1.00 m/s, rising at least 0.10 m/s; it is up at 2.0 m or less; from 400 m within 1 h 08 "
                  "min\n"))
      << text;
  file.mission.safety.vehicle = {};
  const std::string other = checklist(file, walk(), "", {});
  EXPECT_TRUE(has(other, "  holds       hovers\n")) << other;
  EXPECT_TRUE(has(other, "  comes up    floats up by itself\n"));
}

TEST(Checklist, TellsFenceSafePointAndZonesAndWhatSurfaceWaitsFor) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  const std::string text = checklist(file, walk(), "", {});
  EXPECT_TRUE(has(text, "  halt        5 corners, from -2000 to 29600 m north and -2000 to 27000 m east\n")) << text;
  EXPECT_TRUE(has(text, "  safe point  2000 m north, 3000 m east\n"));
  EXPECT_TRUE(has(text, "  no surface  4 corners, from 6000 to 19000 m north and -1500 to 26500 m east\n"));
  const std::string surface = "surface once the height above the sea floor is below 15 m for 2 s";
  EXPECT_TRUE(has(text, surface + "; in a zone of no_surface it leaves that before it comes up\n"));
  file.mission.safety.no_surface.clear();
  file.mission.safety.fence.reset();
  const std::string other = checklist(file, walk(), "", {});
  EXPECT_TRUE(has(other, surface + "\n")) << other;
  EXPECT_TRUE(has(other, "  fence       none: the search is aborted beyond its area\n"));
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
  EXPECT_TRUE(has(checklist(file, walk(), "", {}), "not known: vehicle.battery_percent_per_km is not given"));
}

}  // namespace
}  // namespace earshot::board
