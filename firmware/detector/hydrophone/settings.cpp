#include "firmware/detector/hydrophone/settings.hpp"

#include <cstdint>
#include <limits>

#include "firmware/config/capacities.hpp"
#include "firmware/detector/hydrophone/listening_plan.hpp"

namespace earshot::detector {
namespace {

constexpr Hertz kLowestLow{1.0};
constexpr Hertz kLowestHigh{10.0};
constexpr Hertz kHighestHigh{1000.0};
constexpr Hertz kLeastWidth{1.0};
constexpr double kLeastWidthOverHigh = 0.05;
constexpr Duration kShortestIntegration = Duration::milliseconds(100);
constexpr Duration kLongestIntegration = Duration::seconds(60);
constexpr double kLeastCycles = 2.0;          ///< of the band's width in an integration time: 4 degrees of freedom
constexpr std::int64_t kShortestWindow = 16;  ///< integration times
constexpr Duration kLongestPause = Duration::seconds(60);
constexpr std::uint8_t kMostEstimates = 32;

bool is_within(Decibels level, double least, double most) {
  return level.value >= least && level.value <= most;
}

SettingsFault check_band(const SoundSettings& settings) {
  const Band band = settings.band;
  const bool is_band = band.low >= kLowestLow && band.high > band.low && band.high >= kLowestHigh && band.high <= kHighestHigh &&
                       band.width() >= kLeastWidth && band.width() >= kLeastWidthOverHigh * band.high;
  if (!is_band) return SettingsFault::kBand;
  const bool has_room = lower_flank(band).low >= kLowestLow && upper_flank(band).high <= kHighestHigh;
  return settings.noise_reference == NoiseReference::kFlanks && !has_room ? SettingsFault::kFlanks : SettingsFault::kNone;
}

SettingsFault check_times(const SoundSettings& settings) {
  const Duration time = settings.integration_time;
  if (time < kShortestIntegration || time > kLongestIntegration || time.to_seconds() * settings.band.width().value < kLeastCycles)
    return SettingsFault::kIntegrationTime;
  if (settings.floor_window.us < kShortestWindow * time.us ||
      settings.floor_window.us > static_cast<std::int64_t>(config::kFloorLevels) * time.us)
    return SettingsFault::kFloorWindow;
  return settings.longest_pause < Duration{} || settings.longest_pause > kLongestPause ? SettingsFault::kPause : SettingsFault::kNone;
}

}  // namespace

SettingsFault check(const SoundSettings& settings) {
  if (const SettingsFault fault = check_band(settings); fault != SettingsFault::kNone) return fault;
  if (const SettingsFault fault = check_times(settings); fault != SettingsFault::kNone) return fault;
  if (!is_within(settings.detection_threshold, -10.0, 60.0)) return SettingsFault::kThreshold;
  const MOfN m_of_n = settings.m_of_n;
  if (m_of_n.m < 1 || m_of_n.m > m_of_n.n || m_of_n.n > kMostEstimates) return SettingsFault::kMOfN;
  const double expected = settings.expected_noise.value;
  if (expected == expected && !is_within(settings.expected_noise, -100.0, 300.0)) return SettingsFault::kExpectedNoise;
  if (!(settings.gate.speed.value > 0.0) || !(settings.gate.thruster_rpm > 0.0)) return SettingsFault::kGate;
  if (settings.channels == 0) return SettingsFault::kChannels;
  const Decibels no_noise_known{std::numeric_limits<double>::quiet_NaN()};  // before the block's gain and rate are
  const CalibrationFault chain = check(settings.calibration, Decibels{}, settings.band.high, settings.band, no_noise_known);
  return chain == CalibrationFault::kNone ? SettingsFault::kNone : SettingsFault::kCalibration;
}

const char* to_string(SettingsFault fault) {
  switch (fault) {
    case SettingsFault::kNone:
      return "nothing is wrong with the settings";
    case SettingsFault::kBand:
      return "the band must lie within 1 Hz and 1 kHz, end at 10 Hz or above, and be at least 1 Hz and a twentieth of its high end wide";
    case SettingsFault::kFlanks:
      return "beside the band there must be room, within 1 Hz and 1 kHz, for the bands that the noise is learnt from: each as wide as "
             "the band, a quarter of its width away";
    case SettingsFault::kIntegrationTime:
      return "the integration time must lie from 0.1 to 60 s, and hold two periods of the band's width";
    case SettingsFault::kFloorWindow:
      return "the noise floor's window must hold 16 to 512 integration times";
    case SettingsFault::kThreshold:
      return "the detection threshold must lie from -10 to 60 dB";
    case SettingsFault::kMOfN:
      return "of the last n estimates, 1 to 32, m must be at the threshold or above, 1 to n";
    case SettingsFault::kPause:
      return "the longest pause must lie from 0 to 60 s";
    case SettingsFault::kExpectedNoise:
      return "the noise expected in the band must lie from -100 to 300 dB re 1 uPa";
    case SettingsFault::kGate:
      return "the speed and the thruster's rpm from which the vehicle hears itself must be positive";
    case SettingsFault::kChannels:
      return "at least one channel must be listened to";
    case SettingsFault::kCalibration:
      return "the calibration is impossible";
  }
  return "?";
}

Band audible_part(Band band, Hertz sample_rate) {
  const Hertz highest = sample_rate / kLeastRateOverBand;
  return {.low = band.low, .high = band.high < highest ? band.high : highest};
}

SoundSettings fin_whale() {
  return {};
}

SoundSettings blue_whale() {
  SoundSettings settings;
  settings.band = {.low = Hertz{14.0}, .high = Hertz{17.0}};
  settings.integration_time = Duration::seconds(2);
  settings.floor_window = Duration::seconds(300);
  settings.longest_pause = Duration::seconds(3);
  return settings;
}

SoundSettings antarctic_blue_whale() {
  SoundSettings settings = blue_whale();
  settings.band = {.low = Hertz{17.0}, .high = Hertz{29.0}};
  return settings;
}

SoundSettings continuous_tone() {
  SoundSettings settings;
  settings.band = {.low = Hertz{18.0}, .high = Hertz{22.0}};
  settings.integration_time = Duration::seconds(4);
  settings.floor_window = Duration::seconds(480);
  settings.noise_reference = NoiseReference::kFlanks;
  settings.longest_pause = Duration::seconds(8);
  return settings;
}

}  // namespace earshot::detector
