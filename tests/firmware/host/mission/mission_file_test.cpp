#include "firmware/host/mission/mission_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "firmware/host/mission/ports/flight_needs.hpp"
#include "firmware/host/mission/ports/port_override.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "tests/firmware/host/mission/shipped_mission.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

TEST(MissionFile, TheShippedMissionIsThePapers) {
  const MissionFile file = load_mission(kShipped);
  EXPECT_EQ(file.mission.operating_area.north_east.north.value, 25'000.0);
  EXPECT_EQ(file.mission.operating_area.south_west.east.value, 0.0);
  EXPECT_EQ(file.mission.search_depth.value, 300.0);
  EXPECT_EQ(file.mission.search_speed.value, 2.0);
  EXPECT_EQ(file.mission.step_length.value, 1000.0);
  EXPECT_EQ(file.mission.max_steps, 100);
  EXPECT_EQ(file.mission.detection_threshold.value, 10.0);
  EXPECT_EQ(file.step_period, Duration::seconds(1));
  ASSERT_EQ(file.ports.size(), 1U);
  EXPECT_EQ(file.ports[0].kind, PortKind::kLcm);
  EXPECT_EQ(file.ports[0].roles, (Roles{Role::kNavigation, Role::kSnr, Role::kOperator, Role::kAutopilot, Role::kStatus}));
}

TEST(MissionFile, SearchesForA20HzSourceByTheShippedTablesUnlessTold) {
  EXPECT_EQ(load_mission(kShipped).mission.source_frequency.value, 20.0);
  EXPECT_EQ(load_mission(kShipped).tables, "");
  const support::TemporaryFolder folder;
  std::string text = text_of(kShipped);
  const std::size_t at = text.find("source_frequency_hz");
  text.erase(at, text.find('\n', at) - at);
  std::ofstream(folder / "mine.toml") << text.replace(text.find("[policy]\n"), 9, "[policy]\ntables = \"oceans\"\n");
  EXPECT_EQ(load_mission(folder / "mine.toml").mission.source_frequency.value, 20.0);
  EXPECT_EQ(load_mission(folder / "mine.toml").tables, folder / "oceans");
  EXPECT_NE(complaint("source_frequency_hz = 20.0", "source_frequency_hz = 0.5").find("source_frequency_hz"), std::string::npos);
  EXPECT_EQ(complaint("source_frequency_hz = 20.0", "source_frequency_hz = 35.0"), "");
}

TEST(MissionFile, MakesATurnASecondUnlessTold) {
  const support::TemporaryFolder folder;
  std::string text = text_of(kShipped);
  const std::size_t at = text.find("step_period_s");
  if (at != std::string::npos) text.erase(at, text.find('\n', at) - at);
  std::ofstream(folder / "mine.toml") << text;
  EXPECT_EQ(load_mission(folder / "mine.toml").step_period, Duration::seconds(1));
}

TEST(MissionFile, RefusesATurnLongerThanASecondOrShorterThanATenth) {
  for (const char* wrong : {"1.001", "0.0999"})
    EXPECT_NE(complaint("step_period_s = 1.0", std::string("step_period_s = ") + wrong).find("step_period_s"), std::string::npos) << wrong;
  EXPECT_EQ(complaint("step_period_s = 1.0", "step_period_s = 0.1"), "");
}

TEST(MissionFile, TurnsOnceAPeriodUnlessArrivalsAreToMakeTurns) {
  EXPECT_EQ(load_mission(kShipped).turns, Turns::kPeriodic);
  const support::TemporaryFolder folder;
  std::ofstream(folder / "mine.toml") << "turns = \"on_arrival\"\n" << text_of(kShipped);
  EXPECT_EQ(load_mission(folder / "mine.toml").turns, Turns::kOnArrival);
  EXPECT_NE(complaint("step_period_s", "turns = \"always\"\nstep_period_s").find("turns"), std::string::npos);
}

TEST(MissionFile, HasRoomForSevenPorts) {
  const auto ports = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i)
      text += "[[port]]\nname = \"p" + std::to_string(i) + "\"\nkind = \"can\"\ninterface = \"can" + std::to_string(i) +
              "\"\nroles = [\"snr\"]\n\n";
    return complaint("[origin]", text + "[origin]");
  };
  EXPECT_EQ(ports(6), "");
  EXPECT_NE(ports(7).find("port: has 8 tables, must have at most 7"), std::string::npos) << ports(7);
}

TEST(MissionFile, ComparesNoPortsBeyondThoseThatItHasRoomFor) {
  constexpr int kPorts = 25'000;
  std::string text;
  for (int i = 0; i < kPorts; ++i) text += "[[port]]\nname = \"same\"\nkind = \"can\"\ninterface = \"can0\"\nroles = [\"snr\"]\n\n";
  const std::string given = complaint("[origin]", text + "[origin]");
  EXPECT_TRUE(support::has_line(given, {"port", "25001 tables", "at most 7"})) << given;
  EXPECT_NE(given.find("port 7: "), std::string::npos) << given;
  EXPECT_EQ(given.find("port 8: "), std::string::npos) << given;
}

TEST(MissionFile, HasNoOriginNearAPole) {
  EXPECT_EQ(complaint("latitude_deg = 38.5", "latitude_deg = -80.0"), "");
  EXPECT_NE(complaint("latitude_deg = 38.5", "latitude_deg = 80.1").find("origin.latitude_deg"), std::string::npos);
}

TEST(MissionFile, TakesASeedOfNone) {
  EXPECT_EQ(complaint("action_seed = 1", "action_seed = 0"), "");
}

TEST(MissionFile, HasEachAddressOfAKindOnce) {
  MissionFile file = load_mission(kShipped);
  file.ports.push_back({.name = "bus", .kind = PortKind::kCan, .address = "can0", .roles = {Role::kNavigation}});
  file.ports.push_back({.name = "other", .kind = PortKind::kCan, .address = "can1", .roles = {Role::kNavigation}});
  file.ports.push_back({.name = "again", .kind = PortKind::kCan, .address = "can0", .roles = {Role::kNavigation}});
  EXPECT_EQ(addresses_of(file.ports, PortKind::kCan), (std::vector<std::string>{"can0", "can1"}));
  EXPECT_EQ(addresses_of(file.ports, PortKind::kLcm).size(), 1U);
}

TEST(MissionFile, FilesItNamesAreRelativeToItsOwnFolder) {
  EXPECT_EQ(load_mission(kShipped).policy, std::filesystem::path(EARSHOT_SOURCE_DIR) / "policy/frozen/fixed_source.policy");
}

TEST(MissionFile, ACopyElsewhereNamesItsLineAndThePathThatWasTried) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "mine.toml") << text_of(kShipped);
  MissionFile file = load_mission(folder / "mine.toml");
  const auto complaint_about = [&file] {
    try {
      require_named_files(file);
    } catch (const host::BadInput& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  std::istringstream lines(text_of(kShipped));
  std::size_t number = 1;
  for (std::string line; std::getline(lines, line) && !line.starts_with("file = ");) ++number;
  EXPECT_TRUE(support::tells(complaint_about(), {(folder / "mine.toml").string(), std::to_string(number), "policy.file",
                                                 file.policy.lexically_normal().string(), "no", "relative", "mission's", "--policy"}));
  // --policy names one that is there.
  file.policy_named_at.clear();
  EXPECT_NE(complaint_about().find(":" + std::to_string(number + 1) + ": policy.public_key_file: "), std::string::npos)
      << complaint_about();
  EXPECT_NE(complaint_about().find("--public-key names another"), std::string::npos);
  file.public_key_named_at.clear();
  EXPECT_EQ(complaint_about(), "");
}

TEST(MissionFile, ListensToTheNewestMeasurementUnlessToldOverWhichWindow) {
  EXPECT_EQ(load_mission(kShipped).mission.listening, config::ListeningWindow{});
  const std::string threshold = "detection_threshold_db = 10.0";
  EXPECT_EQ(complaint(threshold, threshold + "\nlistening = \"loudest\"\nlistening_window_s = 30"), "");
  EXPECT_TRUE(support::tells(complaint(threshold, threshold + "\nlistening = \"loudest\"\nlistening_window_s = 121"),
                             {"FILE:21", "search.listening_window_s", "121", "0 to 120"}));
  EXPECT_TRUE(support::tells(complaint(threshold, threshold + "\nlistening_window_s = 30"),
                             {"FILE:20", "search.listening_window_s", "30", "newest", "without", "not", "30 s"}));
  const std::string without = complaint(threshold, threshold + "\nlistening = \"mean\"");
  EXPECT_TRUE(support::has_line(without, {"search.listening_window_s", "mean", "needs", "1 to 120 s", "not 0"})) << without;
  const std::string softest = complaint(threshold, threshold + "\nlistening = \"softest\"");
  EXPECT_TRUE(support::has_line(softest, {"search.listening", "softest", "newest", "loudest", "mean"})) << softest;
}

TEST(MissionFile, RefusesANegativeDepthWithItsLineAndWhatIsAllowed) {
  EXPECT_TRUE(support::tells(complaint("depth_m = 300.0", "depth_m = -300.0"),
                             {"FILE:15", "search.depth_m", "-300.0", "above 0", "at most 11000"}));
}

TEST(MissionFile, RefusesAnUnknownKey) {
  EXPECT_EQ(complaint("speed_mps = 2.0", "speed_mps = 2.0\nspeed_knots = 4.0"), "FILE:17: search.speed_knots: unknown key");
}

TEST(MissionFile, RefusesNan) {
  EXPECT_TRUE(support::has_line(complaint("max_time_s = 60000.0", "max_time_s = nan"), {"limits.max_time_s", "nan"}));
}

TEST(MissionFile, RefusesATimeThatIsLessThanAMicrosecondByItsOwnName) {
  for (const std::string key : {"max_time_s", "navigation_timeout_s", "snr_timeout_s"}) {
    const std::string text = text_of(kShipped);
    const std::size_t at = text.find(key + " = ");
    ASSERT_NE(at, std::string::npos) << key;
    const std::string line = text.substr(at, text.find_first_of(" \n", at + key.size() + 3) - at);
    const std::string what = complaint(line, key + " = 1e-7");
    EXPECT_NE(what.find("limits." + key + " = "), std::string::npos) << what;
    EXPECT_TRUE(support::has_line(what, {"finite", "number", "at least 1e-06"})) << what;
    EXPECT_EQ(what.find("edge_margin_m"), std::string::npos) << what;
  }
}

TEST(MissionFile, RefusesAnAreaWhoseNorthLiesSouthOfItsSouth) {
  EXPECT_TRUE(support::has_line(complaint("north_m = 25000.0", "north_m = -1.0"), {"area.north_m", "-1.0", "greater than south_m"}));
}

TEST(MissionFile, RefusesToSearchDeeperThanTheSafetyLayerAllows) {
  EXPECT_TRUE(support::has_line(complaint("max_depth_m = 400.0", "max_depth_m = 200.0"),
                                {"limits.max_depth_m", "200.0", "at least search.depth_m"}));
}

TEST(MissionFile, RefusesAnAreaWithNoRoomToSearch) {
  EXPECT_TRUE(support::has_line(complaint("edge_margin_m = 250.0", "edge_margin_m = 12400.0"), {"area.edge_margin_m", "12400.0"}));
}

TEST(MissionFile, RefusesAnLcmAddressThatIsNotMulticast) {
  EXPECT_NE(complaint("udpm://239.255.76.67:7667", "udpm://10.0.0.1:7667").find("port 1: url"), std::string::npos);
}

TEST(MissionFile, SaysEverythingThatIsWrongAtOnce) {
  const std::string all =
      complaint("max_steps = 100                  # the mission is over after so many actions\ndetection_threshold_db = 10.0",
                "max_steps = 0\ndetection_threshold_db = \"loud\"");
  EXPECT_NE(all.find("search.max_steps = 0"), std::string::npos) << all;
  EXPECT_NE(all.find("search.detection_threshold_db"), std::string::npos) << all;
}

TEST(MissionFile, RefusesAnLcmPortWithoutAnAddressAndTwoPortsOfOneAddressOrName) {
  EXPECT_NE(complaint("url = \"udpm://239.255.76.67:7667?ttl=0\"\n", "").find("port 1: url is missing"), std::string::npos);
  const std::string twice = complaint(
      "[origin]", "[[port]]\nname = \"vehicle\"\nkind = \"lcm\"\nurl = \"udpm://239.255.76.67:7667?ttl=0\"\nroles = [\"snr\"]\n\n[origin]");
  EXPECT_TRUE(support::has_line(twice, {"port 2", "name", "vehicle", "vehicle", "too"})) << twice;
  EXPECT_NE(twice.find("is there already: give it all roles"), std::string::npos) << twice;
}

TEST(MissionFile, RefusesAPortWhoseNameIsEmptyOrWouldSteerATerminal) {
  EXPECT_TRUE(support::tells(complaint("name = \"vehicle\"", "name = \"\""), {"FILE:30", "port 1", "name", "at least"}));
  EXPECT_EQ(complaint("name = \"vehicle\"", "name = \"a\\u001b[31m\""),
            "FILE:30: port 1: name = \"a\\u001B[31m\": must have no character that steers a terminal");
  EXPECT_EQ(complaint("name = \"vehicle\"", "name = \"Kiel \u00fc\""), "");
}

TEST(MissionFile, RefusesTwoPortsOfOneLcmBusHoweverItsUrlIsSpelledAndSaysWhereTheyStand) {
  EXPECT_TRUE(support::tells(
      complaint("[origin]",
                "[[port]]\nname = \"payload\"\nkind = \"lcm\"\nurl = \"udpm://239.255.76.67:7667?ttl=1\"\nroles = [\"snr\"]\n\n[origin]"),
      {"FILE:38", "port 2", "url", "udpm://239.255.76.67:7667?ttl=1", "vehicle", "already", "FILE:32", "port 1"}));
}

TEST(MissionFile, RefusesTwoPortsOfOneCanInterface) {
  const std::string port = "kind = \"can\"\ninterface = \"can0\"\nroles = [\"navigation\"]\n\n";
  const std::string what = complaint("[origin]", "[[port]]\nname = \"one\"\n" + port + "[[port]]\nname = \"two\"\n" + port + "[origin]");
  EXPECT_TRUE(support::has_line(what, {"port 3", "interface", "can0", "one", "already"})) << what;
}

/// The shipped mission with a CAN port, and what is wrong with it.
std::string complaint_with_interface(const std::string& toml_string) {
  return complaint("[origin]",
                   "[[port]]\nname = \"bus\"\nkind = \"can\"\ninterface = " + toml_string + "\nroles = [\"navigation\"]\n\n[origin]");
}

TEST(MissionFile, RefusesACanInterfaceOfANameThatNoneCanHaveRatherThanWaitForItForEver) {
  const std::string rule =
      ": must be 1 to 15 characters without '/', ':' and white space, and neither \".\" nor \"..\", as Linux names interfaces";
  EXPECT_EQ(complaint_with_interface("\"a/b\""), "FILE:38: port 2: interface = 'a/b'" + rule);
  for (const char* name : {"\"a b\"", "\".\"", "\"..\"", "\"can0:1\"", "\"x\\n\"", "\"can-front.left_1\"", "\"\""}) {
    const std::string what = complaint_with_interface(name);
    EXPECT_TRUE(what.starts_with("FILE:38: port 2: interface")) << name << ": " << what;
  }
  EXPECT_EQ(complaint_with_interface("\"can-front.left1\""), "");
}

TEST(MissionFile, RefusesACommandLinesCanInterfaceOfANameThatNoneCanHave) {
  MissionFile file = load_mission(kShipped);
  try {
    override_ports(file, {.bus = {}, .lcm_url = {}, .can_interface = "x\n"});
    FAIL() << "it was taken";
  } catch (const BadInput& e) {
    EXPECT_STREQ(e.what(),
                 "--can-interface \"x\\n\": must be 1 to 15 characters without '/', ':' and white space, and neither \".\" nor \"..\", as "
                 "Linux names interfaces");
  }
}

/// The shipped mission with a hydrophone, and what is wrong with it.
std::string complaint_with_hydrophone(const std::string& url, const std::string& roles) {
  return complaint("[origin]", "[[port]]\nname = \"ears\"\nkind = \"lcm\"\nurl = \"" + url + "\"\nroles = [" + roles + "]\n\n[origin]");
}

TEST(MissionFile, TakesAHydrophoneOnAGroupOrAPortOfItsOwn) {
  EXPECT_EQ(complaint_with_hydrophone("udpm://239.255.76.67:7668?ttl=0", "\"hydrophone\""), "");
  EXPECT_EQ(complaint_with_hydrophone("udpm://239.255.76.68:7667?ttl=0", "\"hydrophone\""), "");
}

TEST(MissionFile, RefusesAHydrophoneThatSharesItsPortWithOtherRolesOrTheirBus) {
  const std::string together = complaint_with_hydrophone("udpm://239.255.76.67:7668", "\"hydrophone\", \"snr\"");
  EXPECT_TRUE(support::has_line(together, {"port 2", "roles", "hydrophone", "needs"})) << together;
  const std::string shared = complaint_with_hydrophone("udpm://239.255.76.67:7667?ttl=1", "\"hydrophone\"");
  EXPECT_TRUE(support::has_line(shared, {"vehicle", "already", "hydrophone", "needs", "group"})) << shared;
  EXPECT_EQ(shared.find("give it all roles"), std::string::npos) << shared;
  EXPECT_NE(complaint_with_hydrophone("udpm://10.0.0.1:7667", "\"hydrophone\"").find("port 2: url"), std::string::npos);
}

MissionFile mission_with_hydrophone() {
  MissionFile file = load_mission(kShipped);
  file.ports.push_back({.name = "ears", .address = "udpm://239.255.76.67:7668", .roles = {Role::kHydrophone}});
  return file;
}

TEST(MissionFile, LeavesAHydrophoneItsBusWhenACommandLineNamesAnotherForTheRestAndRefusesTheHydrophonesForThem) {
  MissionFile file = mission_with_hydrophone();
  override_ports(file, {.bus = {}, .lcm_url = "udpm://239.255.76.67:7700", .can_interface = {}});
  EXPECT_EQ(file.ports[0].address, "udpm://239.255.76.67:7700");
  EXPECT_EQ(file.ports[1].address, "udpm://239.255.76.67:7668");
  EXPECT_THROW(override_ports(file, {.bus = {}, .lcm_url = "udpm://239.255.76.67:7668?ttl=0", .can_interface = {}}), BadInput);
}

TEST(MissionFile, LeavesAHydrophoneWhereItIsWhenACommandLineNamesTheBusOfTheRest) {
  for (const char* bus : {"lcm", "can", "mixed"}) {
    MissionFile file = mission_with_hydrophone();
    override_ports(file, {.bus = bus, .lcm_url = {}, .can_interface = {}});
    EXPECT_EQ(file.ports.back().address, "udpm://239.255.76.67:7668") << bus;
    EXPECT_TRUE(file.ports.back().roles.has(Role::kHydrophone)) << bus;
    EXPECT_FALSE(file.ports.front().roles.has(Role::kHydrophone)) << bus;
  }
}

TEST(MissionFile, GivesAHydrophoneTheAddressThatACommandLineNamesForItAloneAndRefusesTheRestsBus) {
  MissionFile file = mission_with_hydrophone();
  const std::string vehicle = file.ports[0].address;
  override_ports(file, {.bus = {}, .lcm_url = {}, .hydrophone_url = "udpm://239.255.76.69:7668?ttl=0", .can_interface = {}});
  EXPECT_EQ(file.ports[0].address, vehicle);
  EXPECT_EQ(file.ports[1].address, "udpm://239.255.76.69:7668?ttl=0");
  try {
    override_ports(file, {.bus = {}, .lcm_url = {}, .hydrophone_url = vehicle, .can_interface = {}});
    FAIL() << "it was taken";
  } catch (const BadInput& e) {
    EXPECT_EQ(std::string(e.what()).find("--hydrophone-url \""), 0U) << e.what();
  }
}

TEST(MissionFile, WithoutAHydrophonesPortHasNothingToHearASimulationsSoundWith) {
  MissionFile counting = mission_with_hydrophone();
  EXPECT_THROW(require_hydrophone(counting, "FILE"), BadInput) << "no table states what is listened for";
  counting.hearing.emplace();
  EXPECT_NO_THROW(require_hydrophone(counting, "FILE"));
  try {
    require_hydrophone(load_mission(kShipped), "FILE");
    FAIL() << "it was taken";
  } catch (const BadInput& e) {
    EXPECT_TRUE(support::tells(e.what(), {"--hear", "FILE", "port", "no", "role", "hydrophone", "hear_tone.toml", "hear_calls.toml",
                                          "firmware/boards/linux/missions"}));
  }
}

TEST(MissionFile, HasNoHydrophoneLeftForASimulation) {
  MissionFile file = mission_with_hydrophone();
  leave_out_hydrophones(file);
  ASSERT_EQ(file.ports.size(), 1U);
  EXPECT_EQ(file.ports[0].name, "vehicle");
}

TEST(MissionFile, WithAHydrophoneAndNoSnrSaysAtSeaThatNoTableSaysHowToMeasureOne) {
  MissionFile file = mission_with_hydrophone();
  EXPECT_NO_THROW(require_ports_for_sea(file, "FILE"));
  file.ports[0].roles = {Role::kNavigation, Role::kOperator, Role::kAutopilot};
  try {
    require_ports_for_sea(file, "FILE");
    FAIL() << "it was taken";
  } catch (const BadInput& e) {
    EXPECT_TRUE(support::tells(e.what(), {"FILE", "port", "hydrophone", "no", "SNR", "it", "SNR", "role", "snr"}));
  }
}

}  // namespace
}  // namespace earshot::host
