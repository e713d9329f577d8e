#include "policy/own_search/own_files.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/ports/flight_needs.hpp"
#include "sim/search/scenario/scenario_file.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

#include <fstream>

namespace earshot::own_search {
namespace {

const OwnSearch kOwn{.area_north_m = 20'000.0,
                     .area_east_m = 18'000.0,
                     .latitude_deg = -12.5,
                     .longitude_deg = 100.25,
                     .depth_m = 90.0,
                     .speed_mps = 1.25,
                     .frequency_hz = 35.0,
                     .sea_floor_m = 600.0,
                     .lcm_url = "udpm://239.255.1.2:7001?ttl=1",
                     .bus = "mixed",
                     .can_interface = "can3"};

class OwnFiles : public testing::Test {
 protected:
  std::filesystem::path written(const std::string& text) const {
    std::ofstream(folder_.path() / "file.toml") << text;
    return folder_.path() / "file.toml";
  }
  support::TemporaryFolder folder_;
};

TEST_F(OwnFiles, MissionIsReadBackAsWhatWasAskedFor) {
  const host::MissionFile file = host::load_mission(written(mission_text(kOwn, FliesBy::kOwnPolicy)));
  const Rectangle& area = file.mission.operating_area;
  EXPECT_EQ(area.south_west, (NorthEast{Meters{0.0}, Meters{0.0}}));
  EXPECT_EQ(area.north_east, (NorthEast{Meters{20'000.0}, Meters{18'000.0}}));
  EXPECT_EQ(file.mission.search_depth, Meters{90.0});
  EXPECT_EQ(file.mission.max_depth, Meters{120.0});
  EXPECT_EQ(file.mission.search_speed, MetersPerSecond{1.25});
  EXPECT_EQ(file.mission.source_frequency, Hertz{35.0});
  ASSERT_EQ(file.ports.size(), 2U);
  EXPECT_EQ(file.ports[0].address, "can3");
  EXPECT_EQ(file.ports[1].address, "udpm://239.255.1.2:7001?ttl=1");
  EXPECT_EQ(file.policy, folder_.path() / "search.policy");
  EXPECT_EQ(file.tables, folder_.path() / "search.tables");
  EXPECT_EQ(file.public_key, folder_.path() / "search.pub");
}

TEST_F(OwnFiles, MissionThatFliesByWhatShipsNamesThat) {
  const host::MissionFile file = host::load_mission(written(mission_text({}, FliesBy::kWhatShips)));
  const std::filesystem::path root = EARSHOT_SOURCE_DIR;
  EXPECT_EQ(file.policy, root / "policy/frozen/shipped.policy");
  EXPECT_EQ(file.tables, root / "policy/tables/shipped");
  EXPECT_EQ(file.public_key, root / "policy/frozen/earshot.pub");
}

TEST_F(OwnFiles, MissionsOfEveryBusHaveAllPortsThatTheSeaAsksFor) {
  for (const char* bus : {"lcm", "can", "mixed"}) {
    const std::filesystem::path path = written(mission_text({.bus = bus}, FliesBy::kWhatShips));
    EXPECT_NO_THROW(host::require_ports_for_sea(host::load_mission(path), path)) << bus;
    EXPECT_NE(support::read_text(path).find("\non_found = "), std::string::npos) << bus;
  }
}

TEST_F(OwnFiles, MissionThatHearsListensAboutItsFrequencyAndIsToldNoSnr) {
  for (const char* bus : {"lcm", "can", "mixed"}) {
    const std::filesystem::path path = written(mission_text({.frequency_hz = 35.0, .bus = bus, .hears = true}, FliesBy::kWhatShips));
    const host::MissionFile file = host::load_mission(path);
    EXPECT_NO_THROW(host::require_hydrophone(file, path)) << bus;
    EXPECT_NO_THROW(host::require_ports_for_sea(file, path)) << bus;
    for (const host::PortSettings& port : file.ports) EXPECT_FALSE(port.roles.has(host::Role::kSnr)) << bus;
    ASSERT_TRUE(file.hearing) << bus;
    EXPECT_NEAR(file.hearing->band.low.value, 31.5, 1e-9);
    EXPECT_NEAR(file.hearing->band.high.value, 38.5, 1e-9);
    EXPECT_EQ(file.mission.snr_timeout, Duration::seconds(30));
  }
  EXPECT_NE(readme_text({.hears = true}, FliesBy::kWhatShips, "/own").find(" --hear synthetic\n"), std::string::npos);
  EXPECT_THROW(require_consistent({.frequency_hz = 1'000.0, .hears = true}), host::BadInput);
}

TEST_F(OwnFiles, MissionHasTheFenceAndTheBatteryThatWereAskedFor) {
  const OwnSearch search{
      .area_north_m = 20'000.0, .area_east_m = 18'000.0, .battery_percent = 25.0, .battery_percent_per_km = 1.25, .fence_m = 500.0};
  const config::Safety safety = host::load_mission(written(mission_text(search, FliesBy::kOwnPolicy))).mission.safety;
  ASSERT_TRUE(safety.fence);
  ASSERT_EQ(safety.fence->inside.size(), 4U);
  EXPECT_EQ(safety.fence->inside[2], (NorthEast{Meters{20'500.0}, Meters{18'500.0}}));
  EXPECT_EQ(safety.fence->save[0], (NorthEast{Meters{-1'000.0}, Meters{-1'000.0}}));
  EXPECT_EQ(safety.fence->halt[1], (NorthEast{Meters{22'000.0}, Meters{-2'000.0}}));
  ASSERT_EQ(safety.rules.size(), 2U);
  EXPECT_EQ(safety.rules[0].condition, config::Condition::kBattery);
  EXPECT_EQ(safety.rules[0].limit, 25.0);
  EXPECT_EQ(safety.vehicle.battery_percent_per_km, 1.25);
  EXPECT_EQ(safety.rules[0].response, config::Response::kAbort);
  EXPECT_EQ(support::read_text(folder_.path() / "file.toml").find("# leaving it ends the mission"), std::string::npos);
  EXPECT_EQ(mission_text({}, FliesBy::kWhatShips).find("[fence]"), std::string::npos);
}

TEST_F(OwnFiles, MissionLeavesOpenWhatNobodySaidOfTheBattery) {
  const std::string text = mission_text({.battery_percent = 25.0}, FliesBy::kWhatShips);
  const config::Safety safety = host::load_mission(written(text)).mission.safety;
  EXPECT_EQ(safety.rules[0].condition, config::Condition::kBattery);
  EXPECT_EQ(safety.vehicle.battery_percent_per_km, 0.0) << "not known";
  EXPECT_TRUE(support::has_line(text, {"battery_percent_per_km", "vehicle's", "value"})) << text;
}

TEST_F(OwnFiles, ReadmeFliesWithTheBatteryThatItsMissionHasRulesAboutOrSaysWhatIsMissing) {
  const std::string simulated =
      readme_text({.hears = true, .battery_percent = 25.0, .battery_percent_per_km = 0.6}, FliesBy::kWhatShips, "/own");
  EXPECT_NE(simulated.find(" --hear synthetic --battery-percent 100\n```\n"), std::string::npos) << simulated;
  EXPECT_TRUE(support::has_line(simulated, {"search", "battery", "below 25.0 %"})) << simulated;
  EXPECT_TRUE(support::has_line(simulated, {"without", "no battery", "reported", "`vehicle_status_age_s`"}));
  const std::string open = readme_text({.battery_percent = 25.0}, FliesBy::kWhatShips, "/own");
  EXPECT_EQ(open.find("/flight --battery-percent"), std::string::npos) << open;
  EXPECT_TRUE(support::has_line(open, {"kilometre", "vehicle's", "`battery_percent_per_km`"})) << open;
  EXPECT_EQ(readme_text({}, FliesBy::kWhatShips, "/own").find("battery"), std::string::npos);
}

TEST_F(OwnFiles, OceanIsReadBackAsWhatWasAskedFor) {
  const ocean::Environment environment = search::load_scenario(written(ocean_text(kOwn))).environment;
  EXPECT_EQ(environment.source.frequency, Hertz{35.0});
  EXPECT_EQ(environment.seabed.depth, Meters{600.0});
  EXPECT_TRUE(Rectangle(NorthEast{}, {Meters{20'000.0}, Meters{18'000.0}}).contains(environment.source.position));
}

TEST_F(OwnFiles, OceanStatesWhenThePlaceOfItsSourceCounts) {
  const std::string text = ocean_text(kOwn);
  EXPECT_TRUE(support::has_line(text, {"north_m", "8000.0", "--source", "only"})) << text;
  EXPECT_TRUE(support::has_line(text, {"east_m", "7200.0", "--source", "only"})) << text;
}

TEST_F(OwnFiles, ReadmeStatesWhichPathsToChangeForTheVehicle) {
  const std::string text = readme_text({}, FliesBy::kWhatShips, "/own");
  EXPECT_TRUE(support::has_line(text, {"vehicle", "`mission.toml`", "computer"})) << text;
}

TEST_F(OwnFiles, OceanOfShallowWaterHasItsSourceInTheWater) {
  EXPECT_EQ(search::load_scenario(written(ocean_text({.depth_m = 10.0, .sea_floor_m = 20.0}))).environment.source.depth, Meters{10.0});
}

TEST_F(OwnFiles, PutAnOceanThereThatFitsDepthAndFrequency) {
  const std::string text = ocean_text({.depth_m = 40.0, .frequency_hz = 400.0, .sea_floor_m = 120.0, .source_level_db = 160.0});
  for (const char* untrue : {"munk", "axis", "mud", "Wenz curves at 20 Hz", "the paper"})
    EXPECT_EQ(text.find(untrue), std::string::npos) << untrue;
  const ocean::Environment shelf = search::load_scenario(written(text)).environment;
  EXPECT_EQ(shelf.source.level, Decibels{160.0});
  EXPECT_EQ(shelf.seabed.layers.front().sound_speed, MetersPerSecond{1'650.0}) << "sand";
  const std::string deep = ocean_text({});
  EXPECT_NE(deep.find("deep-sea mud"), std::string::npos);
  EXPECT_NE(deep.find("level_db_re_1upa = 90.0 "), std::string::npos);
  EXPECT_TRUE(support::has_line(ocean_text({.noise_db = 71.0}), {"level_db_re_1upa", "71.0", "--noise-db"}));
}

TEST_F(OwnFiles, ReadmeMakesTablesFirstWhereNoneThatShipAreOfTheSearch) {
  const OwnSearch search{.area_north_m = 30'000.0, .area_east_m = 40'000.0, .depth_m = 512.5};  // a right triangle, 3 : 4 : 5
  const std::string made =
      "```sh\n" + host::own_folder().string() +
      "/earshot tables /own/ocean.toml -o /own/search.tables --key /own/search.key --vehicle-depth-m 512.5 --furthest-m 50000.0\n";
  EXPECT_NE(readme_text(search, FliesBy::kTablesToBeMade, "/own").find(made), std::string::npos)
      << readme_text(search, FliesBy::kTablesToBeMade, "/own");
  EXPECT_EQ(readme_text(search, FliesBy::kOwnPolicy, "/own").find("earshot tables /own"), std::string::npos);
}

TEST_F(OwnFiles, ReadmeFliesOverLcmWhateverTheMissionsBus) {
  EXPECT_EQ(readme_text({}, FliesBy::kWhatShips, "/own").find("--bus"), std::string::npos);
  for (const char* bus : {"can", "mixed"})
    EXPECT_NE(readme_text({.bus = bus}, FliesBy::kWhatShips, "/own").find(" --out /own/flight --bus lcm\n```\n"), std::string::npos) << bus;
}

TEST_F(OwnFiles, CommandsHoldFoldersWithSpacesAndQuotes) {
  EXPECT_NE(readme_text({}, FliesBy::kWhatShips, "/a b").find("--check '/a b/mission.toml'\n"), std::string::npos);
  EXPECT_NE(readme_text({}, FliesBy::kWhatShips, "/a b/it's").find("--check '/a b/it'\\''s/mission.toml'\n"), std::string::npos);
}

}  // namespace
}  // namespace earshot::own_search
