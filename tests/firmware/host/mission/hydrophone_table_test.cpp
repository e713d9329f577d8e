#include "firmware/host/mission/hydrophone_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/ports/flight_needs.hpp"
#include "tests/firmware/host/mission/missions_folder.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

constexpr const char* kTable = R"([hydrophone]
preset = "fin_whale"
sensitivity_db_re_1v_per_upa = -170.0
full_scale_v = 2.0
adc_bits = 16
)";
constexpr const char* kPort = R"([[port]]
name = "ears"
kind = "lcm"
url = "udpm://239.255.76.68:7668?ttl=0"
roles = ["hydrophone"]

)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

std::string mission_with(const std::string& tables) {
  std::ifstream stream(kMissions / "fixed_source.toml");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return replaced(replaced(text, "snr_timeout_s = 5.0", "snr_timeout_s = 20.0"), "[origin]", tables + "\n[origin]");
}

MissionFile mission_of(const std::string& text) {
  const support::TemporaryFolder folder;
  const std::filesystem::path path = folder / "mission.toml";
  std::ofstream(path) << text;
  return load_mission(path);
}

/// What is said about a mission, without the path; empty when it is taken.
std::string complaint_of(const std::string& text) {
  try {
    (void)mission_of(text);
  } catch (const BadInput& e) {
    const std::string what = e.what();
    return what.substr(what.find("mission.toml"));
  }
  return {};
}

/// The same about a mission that listens with another line in its table; the line's own number is left out.
std::string complaint_about(const std::string& line) {
  const std::string key = line.substr(0, line.find(' '));
  std::string table = kTable;
  if (const std::size_t at = table.find(key + " ="); at != std::string::npos) table.erase(at, table.find('\n', at) - at + 1);
  const std::string what = complaint_of(mission_with(kPort + table + line + "\n"));
  const std::size_t place = what.find(": ");
  return place == std::string::npos ? what : what.substr(place + 2);
}

/// A mission for another frequency.
std::string searching_at(const std::string& frequency_hz, const std::string& mission) {
  return replaced(mission, "source_frequency_hz = 20.0", "source_frequency_hz = " + frequency_hz);
}

/// The same without the key: 20 Hz.
std::string searching_at_20_hz_unsaid(const std::string& mission) {
  return replaced(mission, "source_frequency_hz = 20.0", "");
}

TEST(HydrophoneTable, GivesThePresetWithTheChainAndTheMissionsOwnThreshold) {
  const std::string mission = mission_with(std::string(kPort) + kTable);
  const MissionFile file = mission_of(replaced(mission, "detection_threshold_db = 10.0", "detection_threshold_db = 7.0"));
  ASSERT_TRUE(file.hearing);
  const detector::SoundSettings& s = *file.hearing;
  EXPECT_EQ(s.calibration.sensitivity, Decibels{-170});
  EXPECT_EQ(s.calibration.fixed_gain, Decibels{0});
  EXPECT_EQ(s.calibration.full_scale_volts, 2.0);
  EXPECT_EQ(s.calibration.adc_bits, 16);
  EXPECT_EQ(s.calibration.high_pass_corner, Hertz{0});
  EXPECT_EQ(s.band, detector::fin_whale().band);
  EXPECT_EQ(s.integration_time, Duration::seconds(1));
  EXPECT_EQ(s.detection_threshold, Decibels{7}) << "the mission's";
  EXPECT_TRUE(std::isnan(s.expected_noise.value));
  EXPECT_EQ(s.channels, 0xFF);
  EXPECT_NO_THROW(require_ports_for_sea(file, "FILE"));
  EXPECT_NO_THROW(require_hydrophone(file, "FILE"));
}

TEST(HydrophoneTable, TakesOneMeasurementForADetection) {
  const MissionFile file = mission_of(mission_with(std::string(kPort) + kTable + "detection_m = 1\ndetection_n = 1\n"));
  EXPECT_EQ(file.hearing->m_of_n, (detector::MOfN{.m = 1, .n = 1}));
}

TEST(HydrophoneTable, TakesEveryKeyInPlaceOfThePresets) {
  const MissionFile file =
      mission_of(mission_with(std::string(kPort) + replaced(kTable, "fin_whale", "antarctic_blue_whale") + R"(gain_db = 20.0
high_pass_corner_hz = 2.0
band_low_hz = 16.0
band_high_hz = 28.0
integration_time_s = 1.5
floor_window_s = 90.0
longest_pause_s = 2.5
detection_m = 2
detection_n = 3
expected_noise_db_re_1upa = 85.0
self_noise_speed_mps = 2.5
channels = [1, 4]
)"));
  ASSERT_TRUE(file.hearing);
  const detector::SoundSettings& s = *file.hearing;
  EXPECT_EQ(s.calibration.fixed_gain, Decibels{20});
  EXPECT_EQ(s.calibration.high_pass_corner, Hertz{2});
  EXPECT_EQ(s.band, (detector::Band{.low = Hertz{16}, .high = Hertz{28}}));
  EXPECT_EQ(s.integration_time, Duration::milliseconds(1500));
  EXPECT_EQ(s.floor_window, Duration::seconds(90));
  EXPECT_EQ(s.longest_pause, Duration::milliseconds(2500));
  EXPECT_EQ(s.m_of_n, (detector::MOfN{.m = 2, .n = 3}));
  EXPECT_EQ(s.expected_noise, Decibels{85});
  EXPECT_EQ(s.gate.speed, MetersPerSecond{2.5});
  EXPECT_EQ(s.channels, 0b1001);
}

TEST(HydrophoneTable, TakesThePresetsOfAllSources) {
  struct Preset {
    const char* name;
    double low_hz;
    double high_hz;
    std::int64_t integration_s;
    const char* source_hz;
  };
  for (const Preset& preset : {Preset{"fin_whale", 15, 30, 1, "20.0"}, Preset{"blue_whale", 14, 17, 2, "15.5"},
                               Preset{"antarctic_blue_whale", 17, 29, 2, "20.0"}, Preset{"continuous_tone", 18, 22, 4, "20.0"}}) {
    const MissionFile file =
        mission_of(searching_at(preset.source_hz, mission_with(std::string(kPort) + replaced(kTable, "fin_whale", preset.name))));
    ASSERT_TRUE(file.hearing);
    EXPECT_EQ(file.hearing->band, (detector::Band{.low = Hertz{preset.low_hz}, .high = Hertz{preset.high_hz}})) << preset.name;
    EXPECT_EQ(file.hearing->integration_time, Duration::seconds(preset.integration_s)) << preset.name;
  }
}

struct Refused {
  std::string line;
  std::string complaint;  ///< a part of it
};

TEST(HydrophoneTable, RefusesEachValueThatCannotBeWithWhatIsAllowed) {
  for (const auto& [line, complaint] : {
           Refused{"preset = \"sperm_whale\"", "hydrophone.preset"},
           Refused{"sensitivity_db_re_1v_per_upa = 170.0", "must be a finite number of at least -260 and at most -100"},
           Refused{"gain_db = 300.0", "must be a finite number of at least -200 and at most 200"},
           Refused{"full_scale_v = 0.0", "must be a finite number of at least 1e-06 and at most 1000"},
           Refused{"adc_bits = 33", "from 8 to 32"},
           Refused{"high_pass_corner_hz = -1.0", "must be a finite number of at least 0 and at most 1000"},
           Refused{"high_pass_corner_hz = 16.0", "the chain's high-pass corner must not be negative nor above the band's low end"},
           Refused{"band_low_hz = 31.0", "the band must lie within 1 Hz and 1 kHz"},
           Refused{"band_high_hz = 2000.0", "must be a finite number of at least 1 and at most 1000"},
           Refused{"integration_time_s = 61.0", "must be a finite number of at least 0.1 and at most 60"},
           Refused{"integration_time_s = 0.1", "the integration time must lie from 0.1 to 60 s, and hold two periods of the band's width"},
           Refused{"floor_window_s = 15.0", "the noise floor's window must hold 16 to 512 integration times"},
           Refused{"longest_pause_s = 61.0", "must be a finite number of at least 0 and at most 60"},
           Refused{"detection_m = 2", "of the last n estimates, 1 to 32, m must be at the threshold or above, 1 to n"},
           Refused{"detection_n = 33", "from 1 to 32"},
           Refused{"expected_noise_db_re_1upa = 301.0", "must be a finite number of at least -100 and at most 300"},
           Refused{"self_noise_speed_mps = 0.0", "must be a finite number above 0 and at most 20"},
           Refused{"channels = [0]", "must be a finite number of at least 1 and at most 8"},
           Refused{"channels = [1.5]", "must be whole numbers from 1 to 8, each once"},
           Refused{"channels = [2, 2]", "must be whole numbers from 1 to 8, each once"},
           Refused{"channels = []", "at least one channel must be listened to"},
           Refused{"self_noise_rpm = 100.0", "self_noise_rpm"},
       }) {
    const std::string what = complaint_about(line);
    EXPECT_NE(what.find(complaint), std::string::npos) << line << "\nis complained of with: " << what;
    EXPECT_EQ(what.find("hydrophone."), 0U) << "the key is named: " << what;
  }
}

// What stands in its place while the file is read on is none of the user's business.
TEST(HydrophoneTable, ComplainsOfAValueOnce) {
  for (const char* const line : {"integration_time_s = 61.0", "band_high_hz = 2000.0", "detection_n = 33"}) {
    const std::string what = complaint_about(line);
    EXPECT_EQ(what.find("hydrophone.", 1), std::string::npos) << what;
  }
}

TEST(HydrophoneTable, ComplainsOfAThresholdThatNoDetectorHasWhereItStands) {
  const std::string text =
      replaced(mission_with(std::string(kPort) + kTable), "detection_threshold_db = 10.0", "detection_threshold_db = 61.0");
  EXPECT_TRUE(support::has_line(complaint_of(text), {"search.detection_threshold_db", "61.0", "-10 to 60 dB"})) << complaint_of(text);
}

TEST(HydrophoneTable, NeedsOnePortThatBringsSound) {
  const std::string what = complaint_of(mission_with(kTable));
  EXPECT_TRUE(support::has_line(what, {"needs", "[[port]]", "role", "hydrophone", "not 0"})) << what;
}

TEST(HydrophoneTable, RefusesAMissionThatWouldEndWithOneLostBlock) {
  const std::string text = replaced(mission_with(std::string(kPort) + kTable), "snr_timeout_s = 20.0", "snr_timeout_s = 4.0");
  EXPECT_TRUE(support::has_line(complaint_of(text), {"limits.snr_timeout_s", "4.0", "at least 5"})) << complaint_of(text);
}

// A vehicle for 35 Hz that listened at 18 to 22 Hz passed for ready to dive, and heard nothing for 9.4 h.
TEST(HydrophoneTable, RefusesAPresetWhoseBandDoesNotHoldWhatIsSearchedFor) {
  const std::string mission = mission_with(std::string(kPort) + replaced(kTable, "fin_whale", "continuous_tone"));
  const std::string above = complaint_of(searching_at("35.0", mission));
  EXPECT_TRUE(support::has_line(above, {"hydrophone.preset", "continuous_tone", "band_high_hz", "at least 35", "outside", "18 to 22 Hz",
                                        "it", "search.source_frequency_hz", "35"}))
      << above;
  EXPECT_NE(above.find("mission.toml:20)"), std::string::npos) << "where it stands: " << above;
  const std::string below = complaint_of(searching_at("17.9", mission));
  EXPECT_TRUE(support::has_line(below, {"hydrophone.preset", "continuous_tone", "band_low_hz", "at most 17.9"})) << below;
  EXPECT_EQ(complaint_of(searching_at("18.0", mission)), "");
  EXPECT_EQ(complaint_of(searching_at("22.0", mission)), "");
}

TEST(HydrophoneTable, RefusesABandOfItsOwnThatDoesNotHoldWhatIsSearchedFor) {
  const std::string high = complaint_about("band_high_hz = 19.0");
  EXPECT_TRUE(support::tells(high, {"hydrophone.band_high_hz", "19.0", "at least 20", "15 to 19 Hz"})) << high;
  const std::string low = complaint_about("band_low_hz = 21.0");
  EXPECT_TRUE(support::tells(low, {"hydrophone.band_low_hz", "21.0", "at most 20", "21 to 30 Hz"})) << low;
}

// No detector listens above 1 kHz.
TEST(HydrophoneTable, RefusesWhatIsSearchedForAboveEveryBand) {
  const std::string what = complaint_of(searching_at("10000.0", mission_with(std::string(kPort) + kTable)));
  EXPECT_TRUE(support::has_line(what, {"hydrophone.preset", "fin_whale", "band_high_hz", "at least 10000"})) << what;
}

TEST(HydrophoneTable, SaysWhichFrequencyCountsWhereTheMissionNamesNone) {
  const std::string mission = mission_with(std::string(kPort) + replaced(kTable, "fin_whale", "blue_whale"));
  const std::string what = complaint_of(searching_at_20_hz_unsaid(mission));
  EXPECT_TRUE(support::has_line(what, {"hydrophone.preset", "blue_whale", "band_high_hz", "at least 20"})) << what;
  EXPECT_TRUE(support::has_line(what, {"search.source_frequency_hz", "20"})) << what;
}

TEST(HydrophoneTable, RefusesAVehicleThatSearchesFasterThanItHears) {
  const std::string what = complaint_about("self_noise_speed_mps = 1.9");
  EXPECT_TRUE(support::tells(what, {"hydrophone.self_noise_speed_mps", "1.9", "at least 2", "search.speed_mps", "2"})) << what;
  EXPECT_EQ(complaint_about("self_noise_speed_mps = 2.0"), "");
}

TEST(HydrophoneTable, RefusesAChainThatHearsNothingOfTheSeaThatIsExpected) {
  const std::string clipping = complaint_about("expected_noise_db_re_1upa = 200.0");
  EXPECT_TRUE(support::tells(clipping, {"hydrophone.expected_noise_db_re_1upa", "200.0", "clip", "176 dB", "213"})) << clipping;
  const std::string any_sea = complaint_about("gain_db = 200.0");
  EXPECT_TRUE(support::tells(any_sea, {"hydrophone.sensitivity_db_re_1v_per_upa", "-170.0", "clip", "-24 dB", "33"})) << any_sea;
}

TEST(HydrophoneTable, ComplainsOfNoBandWhereTheFrequencyItselfIsWrong) {
  const std::string what = complaint_of(searching_at("0.5", mission_with(std::string(kPort) + kTable)));
  EXPECT_NE(what.find("search.source_frequency_hz"), std::string::npos) << what;
  EXPECT_EQ(what.find("hydrophone."), std::string::npos) << what;
}

TEST(HydrophoneTable, OfTheMissionThatShowsItIsTaken) {
  const MissionFile file = load_mission(kMissions / "hear_at_sea.toml");
  ASSERT_TRUE(file.hearing);
  EXPECT_NO_THROW(require_ports_for_sea(file, "FILE"));
}

}  // namespace
}  // namespace earshot::host
