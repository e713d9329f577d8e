#include "firmware/detector/hydrophone/settings.hpp"

#include <gtest/gtest.h>

#include <string_view>

namespace earshot::detector {
namespace {

template <class Change>
SettingsFault fault_with(Change change) {
  SoundSettings settings = fin_whale();
  change(settings);
  return check(settings);
}

TEST(SoundSettings, FindNothingWrongWithThePresets) {
  for (const SoundSettings& settings : {fin_whale(), blue_whale(), antarctic_blue_whale(), continuous_tone()})
    EXPECT_EQ(check(settings), SettingsFault::kNone);
}

TEST(SoundSettings, AreRefusedEachOutsideItsRange) {
  using S = SoundSettings;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault_with([](S& s) { s.band = {Hertz{0.9}, Hertz{20}}; }), SettingsFault::kBand);
  EXPECT_EQ(fault_with([](S& s) { s.band = {Hertz{30}, Hertz{15}}; }), SettingsFault::kBand);
  EXPECT_EQ(fault_with([](S& s) { s.band = {Hertz{2}, Hertz{9}}; }), SettingsFault::kBand);
  EXPECT_EQ(fault_with([](S& s) { s.band = {Hertz{500}, Hertz{1001}}; }), SettingsFault::kBand);
  EXPECT_EQ(fault_with([](S& s) { s.band = {Hertz{99}, Hertz{100}}; }), SettingsFault::kBand);
  EXPECT_EQ(fault_with([](S& s) { s.band.low = Hertz{kNan}; }), SettingsFault::kBand);
  EXPECT_EQ(fault_with([](S& s) { s.noise_reference = NoiseReference::kFlanks; }), SettingsFault::kFlanks) << "none below 15 Hz";
  EXPECT_EQ(fault_with([](S& s) { s.integration_time = Duration::milliseconds(99); }), SettingsFault::kIntegrationTime);
  EXPECT_EQ(fault_with([](S& s) { s.integration_time = Duration::seconds(61); }), SettingsFault::kIntegrationTime);
  EXPECT_EQ(fault_with([](S& s) { s.integration_time = Duration::milliseconds(130); }), SettingsFault::kIntegrationTime);
  EXPECT_EQ(fault_with([](S& s) { s.floor_window = Duration::seconds(15); }), SettingsFault::kFloorWindow);
  EXPECT_EQ(fault_with([](S& s) { s.floor_window = Duration::seconds(513); }), SettingsFault::kFloorWindow);
  EXPECT_EQ(fault_with([](S& s) { s.detection_threshold = Decibels{61}; }), SettingsFault::kThreshold);
  EXPECT_EQ(fault_with([](S& s) { s.detection_threshold = Decibels{kNan}; }), SettingsFault::kThreshold);
  EXPECT_EQ(fault_with([](S& s) { s.m_of_n = {.m = 3, .n = 2}; }), SettingsFault::kMOfN);
  EXPECT_EQ(fault_with([](S& s) { s.m_of_n = {.m = 0, .n = 2}; }), SettingsFault::kMOfN);
  EXPECT_EQ(fault_with([](S& s) { s.m_of_n = {.m = 1, .n = 33}; }), SettingsFault::kMOfN);
  EXPECT_EQ(fault_with([](S& s) { s.longest_pause = Duration::seconds(-1); }), SettingsFault::kPause);
  EXPECT_EQ(fault_with([](S& s) { s.expected_noise = Decibels{301}; }), SettingsFault::kExpectedNoise);
  EXPECT_EQ(fault_with([](S& s) { s.gate.speed = MetersPerSecond{0}; }), SettingsFault::kGate);
  EXPECT_EQ(fault_with([](S& s) { s.gate.thruster_rpm = kNan; }), SettingsFault::kGate);
  EXPECT_EQ(fault_with([](S& s) { s.channels = 0; }), SettingsFault::kChannels);
  EXPECT_EQ(fault_with([](S& s) { s.calibration.sensitivity = Decibels{180}; }), SettingsFault::kCalibration);
}

TEST(SoundSettings, SayEveryFaultInWordsOfItsOwn) {
  for (int a = 0; a <= static_cast<int>(SettingsFault::kCalibration); ++a) {
    for (int b = 0; b < a; ++b)
      EXPECT_NE(std::string_view(to_string(static_cast<SettingsFault>(a))), to_string(static_cast<SettingsFault>(b)));
  }
}

TEST(SoundSettings, HearAsMuchOfABandAsTheSampleRateHas) {
  const Band band{.low = Hertz{15}, .high = Hertz{30}};
  EXPECT_EQ(audible_part(band, Hertz{66.1}), band);
  EXPECT_NEAR(audible_part(band, Hertz{50}).high.value, 22.727, 1e-3);
  EXPECT_EQ(audible_part(band, Hertz{50}).low, band.low);
}

}  // namespace
}  // namespace earshot::detector
