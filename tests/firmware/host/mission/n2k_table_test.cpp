#include "firmware/host/mission/n2k_table.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/ports/port_override.hpp"
#include "tests/firmware/host/mission/missions_folder.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

using n2k::Measured;

const std::string kAll = "\"navigation\", \"snr\", \"operator\", \"autopilot\", \"status\"";

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A mission over LCM that ships, but with one CAN port; the table's first line is line 35.
struct WithTable {
  explicit WithTable(const std::string& table, const std::string& roles = kAll) {
    std::string text = text_of(kMissions / "fixed_source.toml");
    const std::size_t begin = text.find("\n[[port]]\n") + 1;
    const std::size_t end = text.find("[origin]");
    text.replace(begin, end - begin,
                 "[[port]]\nname = \"bus\"\nkind = \"can\"\ninterface = \"can0\"\nroles = [" + roles + "]\n\n" + table + "\n");
    std::ofstream(folder / "mission.toml") << text;
  }
  [[nodiscard]] N2kSettings settings() const { return load_mission(folder / "mission.toml").ports.at(0).n2k; }
  [[nodiscard]] std::string complaint() const {
    const std::string path = (folder / "mission.toml").string();
    try {
      (void)load_mission(path);
    } catch (const BadInput& e) {
      std::string what = e.what();
      for (std::size_t p = what.find(path); p != std::string::npos; p = what.find(path)) what.replace(p, path.size(), "FILE");
      return what;
    }
    return "";
  }
  support::TemporaryFolder folder;
};

std::string complaint(const std::string& table, const std::string& roles = kAll) {
  return WithTable(table, roles).complaint();
}

const n2k::SourceChoice& source(const N2kSettings& settings, Measured measured) {
  return settings.navigation.sensors.sources[static_cast<std::size_t>(measured)];
}

TEST(N2kTable, MayBeLeftOut) {
  const N2kSettings settings = WithTable("").settings();
  EXPECT_EQ(settings.address, 64);
  EXPECT_EQ(settings.unique_number, 1U);
  EXPECT_EQ(settings.device_instance, 0);
  EXPECT_EQ(settings.navigation.oldest_part, Duration::seconds(3));
  EXPECT_EQ(settings.navigation.sensors.pressure_kind, n2k::PressureKind::kGauge);
  EXPECT_FALSE(settings.zero_pressure_at_surface);
  EXPECT_FALSE(settings.snr_source.name);
}

TEST(N2kTable, OfTheMissionThatExplainsItSaysWhatHoldsWithoutIt) {
  const MissionFile file = load_mission(kMissions / "search_over_can_alone.toml");
  ASSERT_EQ(file.ports.size(), 1U);
  EXPECT_EQ(file.ports[0].roles, kCanRoles);
  const N2kSettings said = file.ports[0].n2k;
  const N2kSettings unsaid = default_n2k(file.mission.navigation_timeout);
  EXPECT_EQ(said.address, unsaid.address);
  EXPECT_EQ(said.unique_number, unsaid.unique_number);
  EXPECT_EQ(said.device_instance, unsaid.device_instance);
  EXPECT_EQ(said.navigation.oldest_part, unsaid.navigation.oldest_part);
  EXPECT_EQ(said.navigation.sensors.pressure_kind, unsaid.navigation.sensors.pressure_kind);
  EXPECT_EQ(said.zero_pressure_at_surface, unsaid.zero_pressure_at_surface);
}

TEST(N2kTable, GivesEveryKey) {
  const N2kSettings settings =
      WithTable(
          "[port.n2k]\naddress = 251\nunique_number = 2097151\ndevice_instance = 255\noldest_part_s = 1.5\npressure = \"absolute\"\n"
          "zero_pressure_at_surface = true\n[port.n2k.sources]\nheading = { name = \"0xC0328600D0E4F1A2\" }\n"
          "depth = { instance = 1, name = \"0x1\" }\nposition = { name = \"0xffffffffffffffff\" }\nvariation = { name = \"0x2\" }\n"
          "speed = { name = \"0x3\" }\nsnr = { name = \"0x4\" }\naltitude = { name = \"0x5\" }\nbattery = { instance = 6 }\n"
          "autopilot = { name = \"0x7\" }")
          .settings();
  EXPECT_EQ(settings.address, 251);
  EXPECT_EQ(settings.unique_number, 2'097'151U);
  EXPECT_EQ(settings.device_instance, 255);
  EXPECT_EQ(settings.navigation.oldest_part, Duration::milliseconds(1500));
  EXPECT_EQ(settings.navigation.sensors.pressure_kind, n2k::PressureKind::kAbsolute);
  EXPECT_TRUE(settings.zero_pressure_at_surface);
  EXPECT_EQ(source(settings, Measured::kHeading).name, 0xC032'8600'D0E4'F1A2);
  EXPECT_FALSE(source(settings, Measured::kHeading).instance);
  EXPECT_EQ(source(settings, Measured::kPressure).name, 1U);
  EXPECT_EQ(source(settings, Measured::kPressure).instance, 1);
  EXPECT_EQ(source(settings, Measured::kPosition).name, 0xFFFF'FFFF'FFFF'FFFF);
  EXPECT_EQ(source(settings, Measured::kVariation).name, 2U);
  EXPECT_EQ(source(settings, Measured::kSpeed).name, 3U);
  EXPECT_EQ(settings.snr_source.name, 4U);
  EXPECT_EQ(source(settings, Measured::kAltitude).name, 5U);
  EXPECT_EQ(source(settings, Measured::kCharge).instance, 6);
  EXPECT_EQ(settings.autopilot_source.name, 7U);
}

TEST(N2kTable, HasNoPartOfAFixOlderThanNavigationMayBe) {
  EXPECT_EQ(default_n2k(Duration::seconds(2)).navigation.oldest_part, Duration::seconds(2));
  EXPECT_TRUE(support::tells(complaint("[port.n2k]\noldest_part_s = 5.5"),
                             {"FILE:36", "port 1", "n2k.oldest_part_s", "5.5", "at least 1e-06", "at most 5"}));
  EXPECT_TRUE(support::tells(complaint("[port.n2k]\noldest_part_s = 0.0"),
                             {"FILE:36", "port 1", "n2k.oldest_part_s", "0.0", "at least 1e-06", "at most 5"}));
}

TEST(N2kTable, RefusesEachNumberOutsideItsBitsWithWhatIsAllowed) {
  EXPECT_TRUE(support::tells(complaint("[port.n2k]\naddress = 252"), {"FILE:36", "port 1", "n2k.address", "252", "0 to 251"}));
  EXPECT_TRUE(support::tells(complaint("[port.n2k]\nunique_number = 2097152"),
                             {"FILE:36", "port 1", "n2k.unique_number", "2097152", "0 to 2097151"}));
  EXPECT_TRUE(
      support::tells(complaint("[port.n2k]\ndevice_instance = 256"), {"FILE:36", "port 1", "n2k.device_instance", "256", "0 to 255"}));
  EXPECT_TRUE(support::tells(complaint("[port.n2k.sources]\ndepth = { instance = 253 }"),
                             {"FILE:36", "port 1", "n2k.sources.depth.instance", "253", "0 to 252"}));
}

TEST(N2kTable, RefusesAPressureOfAnotherKindAndAnAbsoluteOneThatIsNeverZeroed) {
  EXPECT_TRUE(
      support::tells(complaint("[port.n2k]\npressure = \"sealed\""), {"FILE:36", "port 1", "n2k.pressure", "sealed", "gauge", "absolute"}));
  EXPECT_TRUE(support::tells(complaint("[port.n2k]\npressure = \"absolute\""),
                             {"FILE:35", "port 1", "n2k.zero_pressure_at_surface", "true", "no", "before"}));
  EXPECT_TRUE(support::tells(complaint("[port.n2k]\nzero_pressure_at_surface = \"yes\""),
                             {"FILE:36", "port 1", "n2k.zero_pressure_at_surface", "yes", "true", "false"}));
}

TEST(N2kTable, RefusesASourceThatNamesNoDevice) {
  const std::string rule = "must be a device's NAME, 64 bits in hexadecimal: \"0x\" and 1 to 16 digits, not all zero";
  for (const std::string name : {"C0328600D0E4F1A2", "0x", "0x0", "0x10000000000000000", "0xG", "0x1 ", "0x-1"}) {
    EXPECT_EQ(complaint("[port.n2k.sources]\nheading = { name = \"" + name + "\" }"),
              "FILE:36: port 1: n2k.sources.heading.name = '" + name + "': " + rule);
  }
  EXPECT_TRUE(support::tells(complaint("[port.n2k.sources]\nheading = {}"), {"FILE:36", "port 1", "n2k.sources.heading", "name"}));
  EXPECT_TRUE(support::tells(complaint("[port.n2k.sources]\ndepth = {}"), {"FILE:36", "port 1", "n2k.sources.depth", "name", "instance"}));
  EXPECT_TRUE(support::tells(complaint("[port.n2k.sources]\nheading = { instance = 1 }"),
                             {"FILE:36", "port 1", "n2k.sources.heading.instance", "1", "only", "instance"}));
}

TEST(N2kTable, RefusesUnknownKeysOnEveryLevelAndATableOfAnLcmPort) {
  EXPECT_TRUE(
      support::lines_tell(complaint("[port.n2k]\nadress = 3\n[port.n2k.sources]\nwind = { name = \"0x1\" }\ndepth = { serial = 1 }"),
                          {{"FILE:39", "port 1", "n2k.sources.depth", "both"},
                           {"FILE:36", "port 1", "n2k.adress", "unknown"},
                           {"FILE:38", "port 1", "n2k.sources.wind", "unknown"},
                           {"FILE:39", "port 1", "n2k.sources.depth.serial", "unknown"}}));
  EXPECT_EQ(
      complaint("[[port]]\nname = \"l\"\nkind = \"lcm\"\nurl = \"udpm://239.255.76.67:7667\"\nroles = [\"snr\"]\n[port.n2k]\naddress = 3"),
      "FILE:40: port 2: n2k: unknown key");
}

TEST(N2kTable, RefusesKeysThatThePortsRolesHaveNoUseFor) {
  EXPECT_TRUE(support::lines_tell(
      complaint("[port.n2k]\noldest_part_s = 1.0\npressure = \"gauge\"\nzero_pressure_at_surface = true\n[port.n2k.sources]\n"
                "heading = { name = \"0x1\" }\nsnr = { name = \"0x1\" }",
                "\"autopilot\""),
      {{"FILE:36", "port 1", "n2k.oldest_part_s", "1.0", "only", "role", "navigation"},
       {"FILE:37", "port 1", "n2k.pressure", "gauge", "only", "role", "navigation"},
       {"FILE:38", "port 1", "n2k.zero_pressure_at_surface", "true", "only", "role", "navigation"},
       {"FILE:40", "port 1", "n2k.sources.heading", "only", "role", "navigation"},
       {"FILE:41", "port 1", "n2k.sources.snr", "only", "role", "snr"}}));
}

TEST(N2kTable, RefusesAnAutopilotsNameForAPortWithoutThatRole) {
  EXPECT_TRUE(support::tells(complaint("[port.n2k.sources]\nautopilot = { name = \"0x1\" }", "\"navigation\""),
                             {"FILE:36", "port 1", "n2k.sources.autopilot", "only", "role", "autopilot"}));
}

TEST(N2kTable, RefusesSoundOverCan) {
  EXPECT_TRUE(
      support::tells(complaint("", "\"hydrophone\""), {"FILE:33", "port 1", "roles", "CAN", "no sound", "hydrophone", "needs", "lcm"}));
}

TEST(N2kTable, StaysThatOfTheMissionWhenACommandLineNamesTheBusAndIsWhatHoldsWithoutOneElse) {
  const WithTable over_can("[port.n2k]\naddress = 77\nunique_number = 9");
  for (const char* bus : {"can", "mixed"}) {
    MissionFile file = load_mission(over_can.folder / "mission.toml");
    override_ports(file, {.bus = bus, .lcm_url = {}, .can_interface = {}});
    EXPECT_EQ(file.ports[0].n2k.address, 77) << bus;
    EXPECT_EQ(file.ports[0].n2k.unique_number, 9U) << bus;
    EXPECT_EQ(file.ports[0].roles, std::string(bus) == "can" ? kCanRoles : Roles{Role::kNavigation});
  }
  MissionFile over_lcm = load_mission(kMissions / "search.toml");
  override_ports(over_lcm, {.bus = "can", .lcm_url = {}, .can_interface = {}});
  ASSERT_EQ(over_lcm.ports.size(), 1U);
  EXPECT_EQ(over_lcm.ports[0].n2k.address, 64);
  EXPECT_EQ(over_lcm.ports[0].n2k.navigation.oldest_part, Duration::seconds(3));
}

TEST(N2kTable, OfASimulationLeavesItsSnrToTheSimulator) {
  MissionFile file = load_mission(kMissions / "search_over_can_alone.toml");
  file.ports.push_back({.name = "lcm", .address = "udpm://239.255.76.67:7667", .roles = {Role::kSnr}});
  leave_snr_to_simulator(file);
  EXPECT_EQ(file.ports[0].roles, (Roles{Role::kNavigation, Role::kOperator, Role::kAutopilot, Role::kStatus}));
  EXPECT_TRUE(file.ports[1].roles.has(Role::kSnr)) << "the simulator's bearings come by it";
  EXPECT_TRUE(file.ports[1].snr_is_simulators);
}

}  // namespace
}  // namespace earshot::host
