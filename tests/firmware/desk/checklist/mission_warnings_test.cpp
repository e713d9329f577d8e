#include "firmware/desk/checklist/mission_warnings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "firmware/messages/dictionary/mission_words.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

const std::string kMissions = std::string(EARSHOT_SOURCE_DIR) + "/firmware/boards/linux/missions/";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool is_warned_of(const host::MissionFile& file, support::Facts facts) {
  return std::ranges::any_of(mission_warnings(file), [facts](const std::string& warning) { return bool{support::tells(warning, facts)}; });
}

TEST(MissionWarnings, DoubtsWhatIsAllowedAndUnwise) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  EXPECT_TRUE(is_warned_of(file, {"authority.key_file"}));
  EXPECT_EQ(mission_warnings(file).size(), 1U);
  file.command_key = host::CommandKey(host::KeyBytes{1});
  EXPECT_TRUE(mission_warnings(file).empty());
  file.mission.max_depth = file.mission.search_depth + Meters{2.0};
  EXPECT_TRUE(mission_warnings(file).empty());
  file.mission.max_depth = file.mission.search_depth + Meters{1.5};
  EXPECT_TRUE(is_warned_of(file, {"search.depth_m", "1.5 m", "above limits.max_depth_m"}));
  file.mission.max_steps = 128;
  EXPECT_FALSE(is_warned_of(file, {"search.max_steps"}));
  file.mission.max_steps = 129;
  EXPECT_TRUE(is_warned_of(file, {"search.max_steps", "129", "no", "SNR", "129"}));
  file.mission.max_steps = 100;
  file.mission.max_time = Duration::seconds(49'999);
  EXPECT_TRUE(is_warned_of(file, {"limits.max_time_s", "before", messages::to_string(messages::EndReason::kStepsUsedUp)}));
  file.mission.safety.vehicle.battery_percent_per_km = 1.01;
  EXPECT_TRUE(is_warned_of(file, {"all steps need 101 % of a battery"}));
  file.mission.safety.rules.clear();
  EXPECT_TRUE(is_warned_of(file, {"no rule watches the battery"}));
  file.mission.safety.fence.reset();
  EXPECT_TRUE(is_warned_of(file, {"there is no [fence]"}));
  file.mission.safety.vehicle = {};
  EXPECT_TRUE(is_warned_of(file, {"there is no [vehicle]"}));
  file.ports.push_back({.name = "bus", .kind = host::PortKind::kCan, .address = "nosuchbus0", .roles = {}});
  EXPECT_TRUE(is_warned_of(file, {"computer", "no interface", "nosuchbus0", "now"}));
}

// asin(0.8 / 1.0) = 53.1 degrees.
TEST(MissionWarnings, DoubtsAVehicleThatRisesAlmostAsFastAsItMoves) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  config::VehicleLimits& vehicle = file.mission.safety.vehicle;
  vehicle.ascent_rate = MetersPerSecond{0.5};
  EXPECT_FALSE(is_warned_of(file, {"ascent_rate_mps"}));
  vehicle.ascent_rate = MetersPerSecond{0.8};
  EXPECT_TRUE(is_warned_of(file, {"vehicle.ascent_rate_mps", "0.8 m/s", "53 degrees", "way", "below", "surface"}));
  vehicle.ascent_speed = MetersPerSecond{0.0};
  EXPECT_TRUE(is_warned_of(file, {"vehicle.ascent_rate_mps", "not used", "ascent_speed_mps", "0 floats", "up"}));
  vehicle.ascent_rate = config::kSlowestAscent;
  EXPECT_FALSE(is_warned_of(file, {"ascent_rate_mps"}));
}

TEST(MissionWarnings, DoubtsAVehicleOfWhichNobodySaysTheCurrent) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  file.mission.safety.vehicle.max_current = MetersPerSecond{0.0};
  EXPECT_TRUE(is_warned_of(file, {"vehicle.max_current_mps", "not given", "any", "up", "4 m/s"}));
  file.mission.safety.vehicle = {};
  EXPECT_FALSE(is_warned_of(file, {"max_current_mps"})) << "that there is no [vehicle] is doubted as a whole";
}

TEST(MissionWarnings, DoubtsAVehiclesNameThatNoOrderIsMarkedFor) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  EXPECT_FALSE(is_warned_of(file, {"vehicle_id"}));
  file.challenge = host::new_challenge("auv-7", {});
  EXPECT_TRUE(is_warned_of(file, {"vehicle_id", "auv-7", "no", "without authority.key_file"}));
  file.command_key = host::CommandKey(host::KeyBytes{1});
  EXPECT_FALSE(is_warned_of(file, {"vehicle_id"}));
}

// Home from (25, 25) km to (2, 3) km: 31.83 km, against 0.4 m/s 39.79 km. At 0.9 % a kilometre the steps alone take 90 %, and with the way
// home 125.8 %.
TEST(MissionWarnings, DoubtsABatteryThatLastsForTheSearchButNotForTheWayHome) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  file.mission.safety.vehicle.battery_percent_per_km = 0.9;
  EXPECT_TRUE(is_warned_of(file, {"longest", "home", "126 %", "battery"}));
  file.mission.safety.safe_point.reset();
  EXPECT_FALSE(is_warned_of(file, {"way home need"}));
}

TEST(MissionWarnings, DoubtsABatteryOfWhichNobodySaysHowFarItLasts) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  file.mission.safety.rules.clear();
  ASSERT_EQ(file.mission.safety.rules.push_back({.condition = config::Condition::kBattery, .limit = 20.0, .persistence = {}}), Status::kOk);
  EXPECT_FALSE(is_warned_of(file, {"whether the battery lasts"}));
  file.mission.safety.vehicle.battery_percent_per_km = 0.0;
  EXPECT_TRUE(is_warned_of(file, {"vehicle.battery_percent_per_km", "not given", "not"}));
}

TEST(MissionWarnings, DoubtsAChargeAtHomeThatCountsNoWay) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  file.mission.safety.vehicle.battery_percent_per_km = 0.0;
  EXPECT_TRUE(is_warned_of(file, {"battery_at_home_percent", "counts", "no", "home"}));
  file.mission.safety.rules.clear();
  EXPECT_FALSE(is_warned_of(file, {"counts no way home"}));
}

TEST(MissionWarnings, DoubtsARuleAboutADeafHydrophoneThatNoPortCanTellOf) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  EXPECT_FALSE(is_warned_of(file, {"hydrophone_deaf"}));
  file.ports.at(0).roles.remove(host::Role::kSnr);
  EXPECT_TRUE(is_warned_of(file, {"no", "role", "snr", "no", "to", "nobody", "hydrophone_deaf"}));
  file.ports.at(0).roles.add(host::Role::kHydrophone);
  EXPECT_TRUE(is_warned_of(file, {"hydrophone_deaf"})) << "its samples are counted only";
  file.hearing = detector::fin_whale();
  EXPECT_FALSE(is_warned_of(file, {"hydrophone_deaf"}));
  file.mission.safety.rules.clear();
  EXPECT_FALSE(is_warned_of(file, {"hydrophone_deaf"}));
}

// 100 km over ground at 1.6 m/s: 62 500 s.
TEST(MissionWarnings, CountTheCurrentInTheTime) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  file.mission.max_time = Duration::seconds(62'499);
  EXPECT_TRUE(is_warned_of(file, {"limits.max_time_s", "62499 s", "before", messages::to_string(messages::EndReason::kStepsUsedUp),
                                  "vehicle.max_current_mps", "0.4 m/s", "62500 s"}));
  file.mission.max_time = Duration::seconds(62'500);
  EXPECT_FALSE(is_warned_of(file, {"max_time_s"}));
}

config::Polygon box(double south, double west, double side) {
  config::Polygon polygon;
  for (const auto& [north, east] : {std::pair{south, west}, {south + side, west}, {south + side, west + side}, {south, west + side}})
    (void)polygon.push_back({.north = Meters{north}, .east = Meters{east}});
  return polygon;
}

// The halt polygon: south of its tip, from -2000 to 27 000 m each way.
TEST(MissionWarnings, NameAZoneWhereNoSearchCanBe) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  const auto is_beyond = [&file](const config::Polygon& zone) {
    file.mission.safety.no_surface.clear();
    (void)file.mission.safety.no_surface.push_back(zone);
    return is_warned_of(file, {"no_surface 1 lies wholly beyond"});
  };
  EXPECT_TRUE(is_beyond(box(-9000, 0, 6000)));
  EXPECT_FALSE(is_beyond(box(-9000, 0, 8000))) << "its northern corners are in it";
  EXPECT_FALSE(is_beyond(box(-90'000, -90'000, 200'000))) << "all of the fence is in the zone";
  config::Polygon strip;  // across, from west to east: no corner of either lies in the other
  for (const auto& [north, east] : {std::pair{5000.0, -9000.0}, {6000.0, -9000.0}, {6000.0, 90'000.0}, {5000.0, 90'000.0}})
    (void)strip.push_back({.north = Meters{north}, .east = Meters{east}});
  EXPECT_FALSE(is_beyond(strip));
  file.mission.safety.fence.reset();  // then the area, from 0 to 25 000 m
  EXPECT_TRUE(is_beyond(box(-1500, 0, 1000)));
  EXPECT_FALSE(is_beyond(box(24'000, 24'000, 5000)));
}

TEST(MissionWarnings, NameAKeyThatIsNoSecret) {
  host::MissionFile file = host::load_mission(kMissions + "fenced_search.toml");
  file.command_key = host::CommandKey(host::KeyBytes{});
  EXPECT_TRUE(is_warned_of(file, {"authority.key_file", "zeros"}));
  file.command_key = host::CommandKey(host::KeyBytes{1});
  EXPECT_TRUE(mission_warnings(file).empty()) << mission_warnings(file)[0];
}

TEST(MissionWarnings, DoubtsNothingOfTheHearingInTheMissionsThatShip) {
  for (const char* const name : {"hear_at_sea.toml", "hear_calls.toml", "hear_tone.toml"}) {
    const host::MissionFile file = host::load_mission(kMissions + name);
    const bool knows_the_sea = file.hearing->expected_noise == file.hearing->expected_noise;
    const std::vector<std::string> warnings = mission_warnings(file);
    EXPECT_EQ(std::ranges::count_if(warnings, [](const std::string& warning) { return has(warning, "hydrophone"); }), knows_the_sea ? 0 : 1)
        << name;
    EXPECT_EQ(is_warned_of(file, {"hydrophone.expected_noise_db_re_1upa", "left out"}), !knows_the_sea) << name;
  }
}

// A tone of 21.0 Hz less and more 5 %: 19.95 to 22.05 Hz, of which 18 to 22 Hz is heard.
TEST(MissionWarnings, DoubtsASoundAtAnEndOfTheBand) {
  host::MissionFile file = host::load_mission(kMissions + "hear_tone.toml");
  file.mission.source_frequency = Hertz{20.9};
  EXPECT_FALSE(is_warned_of(file, {"hydrophone's band"}));
  file.mission.source_frequency = Hertz{21.0};
  EXPECT_TRUE(is_warned_of(file, {"search.source_frequency_hz", "21 Hz", "within 5 %", "18 to 22 Hz"}));
  file.mission.source_frequency = Hertz{18.9};
  EXPECT_TRUE(is_warned_of(file, {"search.source_frequency_hz, 18.9 Hz"}));
}

// Full scale lies at 176.02 dB re 1 uPa less the gain, and a source at the threshold needs 103 (tests of HydrophoneChain).
TEST(MissionWarnings, DoubtsAChainInWhichANearSourceClips) {
  host::MissionFile file = host::load_mission(kMissions + "hear_at_sea.toml");
  file.hearing->calibration.fixed_gain = Decibels{53.0};
  EXPECT_FALSE(is_warned_of(file, {"the hydrophone's chain clips"}));
  file.hearing->calibration.fixed_gain = Decibels{53.1};
  EXPECT_TRUE(is_warned_of(file, {"122.9 dB", "32.9 dB", "above", "hydrophone.expected_noise_db_re_1upa"}));
}

// At 250 Hz the ADC's noise is 17.55 dB less the gain, and 16 dB under the expected 90 are 74.
TEST(MissionWarnings, DoubtsAChainWhoseAdcHidesAQuietSea) {
  host::MissionFile file = host::load_mission(kMissions + "hear_at_sea.toml");
  file.hearing->calibration.fixed_gain = Decibels{-56.4};
  EXPECT_FALSE(is_warned_of(file, {"the ADC's own noise"}));
  file.hearing->calibration.fixed_gain = Decibels{-56.5};
  EXPECT_TRUE(is_warned_of(file, {"74.0 dB", "250 Hz", "48.2", "96000 Hz"}));
}

TEST(MissionWarnings, DoubtsADeviceThatNobodyMakes) {
  host::MissionFile file = host::load_mission(kMissions + "hear_at_sea.toml");
  detector::Calibration& chain = file.hearing->calibration;
  EXPECT_FALSE(is_warned_of(file, {" have "}));
  chain.sensitivity = Decibels{-259.0};
  EXPECT_TRUE(is_warned_of(file, {"hydrophone.sensitivity_db_re_1v_per_upa", "-259", "-225 to -120"}));
  chain.sensitivity = Decibels{-101.0};
  EXPECT_TRUE(is_warned_of(file, {"hydrophone.sensitivity_db_re_1v_per_upa, -101"}));
  chain.fixed_gain = Decibels{121.0};
  EXPECT_TRUE(is_warned_of(file, {"hydrophone.gain_db", "121", "-40 to 120"}));
  chain.full_scale_volts = 1000.0;
  EXPECT_TRUE(is_warned_of(file, {"hydrophone.full_scale_v, 1000: ADCs have 0.01 to 30"}));
  chain.adc_bits = 8;
  EXPECT_TRUE(is_warned_of(file, {"hydrophone.adc_bits", "8", "12 to 32"}));
}

TEST(MissionWarnings, DoubtsCallsOfWhichOneInstantIsHeard) {
  host::MissionFile file = host::load_mission(kMissions + "hear_calls.toml");
  file.mission.listening = {};
  EXPECT_TRUE(is_warned_of(file, {"search.listening is \"newest\""}));
  file.hearing->noise_reference = detector::NoiseReference::kFlanks;
  EXPECT_FALSE(is_warned_of(file, {"search.listening is \"newest\""})) << "a tone has no pauses";
}

TEST(MissionWarnings, DoubtsAnIntegrationTimeThatNeitherWindowNorLegHolds) {
  host::MissionFile file = host::load_mission(kMissions + "hear_tone.toml");
  file.mission.listening.length = Duration::seconds(4);
  EXPECT_FALSE(is_warned_of(file, {"hydrophone.integration_time_s"}));
  file.mission.listening.length = Duration::seconds(3);
  EXPECT_TRUE(is_warned_of(file, {"search.listening_window_s", "3 s", "hydrophone.integration_time_s", "4 s"}));
  file.mission.step_length = Meters{7.0};
  EXPECT_TRUE(is_warned_of(file, {"hydrophone.integration_time_s", "4 s", "7 m", "2 m/s", "3.5 s"}));
}

TEST(MissionWarnings, DoubtsAGateThatACurrentCloses) {
  host::MissionFile file = host::load_mission(kMissions + "hear_at_sea.toml");
  EXPECT_FALSE(is_warned_of(file, {"hydrophone.self_noise_speed_mps"}));
  file.mission.safety.vehicle.max_current = MetersPerSecond{1.1};
  EXPECT_TRUE(is_warned_of(file, {"hydrophone.self_noise_speed_mps", "3 m/s", "less than search.speed_mps", "vehicle.max_current_mps"}));
}

}  // namespace
}  // namespace earshot::board
