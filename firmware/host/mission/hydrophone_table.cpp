#include "firmware/host/mission/hydrophone_table.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/detector/hydrophone/listening_plan.hpp"
#include "firmware/host/mission/hydrophone_chain.hpp"
#include "firmware/host/mission/rule_words.hpp"

namespace earshot::host {
namespace {

using detector::SettingsFault;
using detector::SoundSettings;

constexpr const char* kPreset = "preset";
constexpr const char* kSensitivity = "sensitivity_db_re_1v_per_upa";
constexpr const char* kHighPassCorner = "high_pass_corner_hz";
constexpr const char* kBandLow = "band_low_hz";
constexpr const char* kBandHigh = "band_high_hz";
constexpr const char* kIntegrationTime = "integration_time_s";
constexpr const char* kFloorWindow = "floor_window_s";
constexpr const char* kLongestPause = "longest_pause_s";
constexpr const char* kM = "detection_m";
constexpr const char* kN = "detection_n";
constexpr const char* kExpectedNoise = "expected_noise_db_re_1upa";
constexpr const char* kSelfNoiseSpeed = "self_noise_speed_mps";
constexpr const char* kChannels = "channels";
constexpr const char* kThreshold = "detection_threshold_db";
constexpr const char* kFrequency = "source_frequency_hz";
constexpr const char* kSpeed = "speed_mps";
constexpr std::array kJudgedKeys{kPreset,  kSensitivity,   "gain_db",        "full_scale_v", "adc_bits",    kHighPassCorner,
                                 kBandLow, kBandHigh,      kIntegrationTime, kFloorWindow,   kLongestPause, kM,
                                 kN,       kExpectedNoise, kSelfNoiseSpeed,  kChannels};

SoundSettings preset_named_by(TableReader& table) {
  switch (table.choice(kPreset, {"fin_whale", "blue_whale", "antarctic_blue_whale", "continuous_tone"})) {
    case 1:
      return detector::blue_whale();
    case 2:
      return detector::antarctic_blue_whale();
    case 3:
      return detector::continuous_tone();
    default:
      return detector::fin_whale();
  }
}

detector::Calibration read_calibration(TableReader& table) {
  return {.sensitivity = Decibels{table.number(kSensitivity, Range::between(-260.0, -100.0))},
          .fixed_gain = Decibels{table.number_or("gain_db", 0.0, Range::between(-200.0, 200.0))},
          .full_scale_volts = table.number("full_scale_v", Range::between(1e-6, 1e3)),
          .adc_bits = static_cast<int>(table.integer("adc_bits", 8, 32)),
          .high_pass_corner = Hertz{table.number_or(kHighPassCorner, 0.0, Range::between(0.0, 1000.0))}};
}

Duration duration_or(TableReader& table, const char* key, Duration fallback, Range range) {
  return {std::llround(1e6 * table.number_or(key, fallback.to_seconds(), range))};
}

void read_overrides(TableReader& table, SoundSettings& settings) {
  const Range audible = Range::between(1.0, 1000.0);
  settings.band = {.low = Hertz{table.number_or(kBandLow, settings.band.low.value, audible)},
                   .high = Hertz{table.number_or(kBandHigh, settings.band.high.value, audible)}};
  settings.integration_time = duration_or(table, kIntegrationTime, settings.integration_time, Range::between(0.1, 60.0));
  settings.floor_window = duration_or(table, kFloorWindow, settings.floor_window, Range::between(1.6, 30'720.0));
  settings.longest_pause = duration_or(table, kLongestPause, settings.longest_pause, Range::between(0.0, 60.0));
  settings.m_of_n = {.m = static_cast<std::uint8_t>(table.integer_or(kM, settings.m_of_n.m, 1, 32)),
                     .n = static_cast<std::uint8_t>(table.integer_or(kN, settings.m_of_n.n, 1, 32))};
  if (table.has(kExpectedNoise)) settings.expected_noise = Decibels{table.number(kExpectedNoise, Range::between(-100.0, 300.0))};
  if (table.has(kSelfNoiseSpeed)) settings.gate.speed = MetersPerSecond{table.number(kSelfNoiseSpeed, Range::above_up_to(0.0, 20.0))};
}

void read_channels(TableReader& table, SoundSettings& settings) {
  if (!table.has(kChannels)) return;
  constexpr auto kMost = static_cast<double>(config::kHydrophoneChannels);
  settings.channels = 0;
  for (const double channel : table.numbers(kChannels, Range::between(1.0, kMost))) {
    const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(channel - 1.0));
    const bool is_new_and_whole = channel == std::floor(channel) && (settings.channels & bit) == 0;
    if (!is_new_and_whole && !table.is_noted(kChannels)) table.problem(kChannels, "must be whole numbers from 1 to 8, each once");
    settings.channels = static_cast<std::uint8_t>(settings.channels | bit);
  }
}

/// The key that a fault is complained of at.
const char* key_of(SettingsFault fault) {
  switch (fault) {
    case SettingsFault::kFlanks:
      return kBandHigh;
    case SettingsFault::kIntegrationTime:
      return kIntegrationTime;
    case SettingsFault::kFloorWindow:
      return kFloorWindow;
    case SettingsFault::kMOfN:
      return kM;
    case SettingsFault::kPause:
      return kLongestPause;
    case SettingsFault::kExpectedNoise:
      return kExpectedNoise;
    case SettingsFault::kGate:
      return kSelfNoiseSpeed;
    case SettingsFault::kChannels:
      return kChannels;
    case SettingsFault::kCalibration:
      return kHighPassCorner;
    case SettingsFault::kNone:
    case SettingsFault::kBand:
    case SettingsFault::kThreshold:
      break;
  }
  return kBandLow;
}

/// The chain's own fault where it is that: nothing is known before the first block of its gain and sample rate.
std::string reason_of(SettingsFault fault, const SoundSettings& settings) {
  if (fault != SettingsFault::kCalibration) return to_string(fault);
  const Decibels not_known{std::numeric_limits<double>::quiet_NaN()};
  return to_string(check(settings.calibration, Decibels{}, settings.band.high, settings.band, not_known));
}

bool is_anything_noted(const TableReader& table) {
  for (const char* const key : kJudgedKeys) {
    if (table.is_noted(key)) return true;
  }
  return false;
}

/// "search.source_frequency_hz = 20 (mission.toml:20)", and that nothing says so where the key is left out.
std::string stated_in(const TableReader& search, const char* key, double value) {
  const std::string setting = std::string("search.") + key + " = " + shortly(value);
  if (!search.has(key)) return setting + ", which counts where it is left out";
  const std::string place = search.place_of(key);
  return setting + " (" + place.substr(0, place.rfind(": ")) + ")";
}

/// The band is the preset's where no key of its own says so.
void require_band_of_source(TableReader& hydrophone, const TableReader& search, const detector::Band& band, Hertz frequency) {
  const bool is_below = frequency < band.low;
  if (!is_below && frequency <= band.high) return;
  const char* const key = is_below ? kBandLow : kBandHigh;
  const std::string limit = std::string(is_below ? "at most " : "at least ") + shortly(frequency.value);
  const std::string must = hydrophone.has(key) ? "must be " + limit : std::string(key) + " must be " + limit;
  hydrophone.problem(hydrophone.has(key) ? key : kPreset,
                     must + ": what is searched for lies outside of the band of " + shortly(band.low.value) + " to " +
                         shortly(band.high.value) +
                         " Hz, and the vehicle would hear nothing of it: " + stated_in(search, kFrequency, frequency.value));
}

void require_open_gate(TableReader& hydrophone, const TableReader& search, MetersPerSecond gate, MetersPerSecond speed) {
  if (speed <= gate) return;
  hydrophone.problem(kSelfNoiseSpeed, "must be at least " + shortly(speed.value) +
                                          ": faster than that the vehicle measures nothing, and it searches at " +
                                          stated_in(search, kSpeed, speed.value));
}

/// What can be known before a block has come with its own gain and sample rate.
void require_chain(TableReader& hydrophone, const SoundSettings& settings) {
  const std::string reason = reason_for_deafness(settings);
  if (!reason.empty()) hydrophone.problem(hydrophone.has(kExpectedNoise) ? kExpectedNoise : kSensitivity, reason);
}

/// Of settings that no detector refuses: whether they hear what the mission searches for.
void require_hearing(TableReader& hydrophone, const TableReader& search, const SoundSettings& settings, const config::Mission& mission) {
  if (!search.is_noted(kFrequency)) require_band_of_source(hydrophone, search, settings.band, mission.source_frequency);
  require_chain(hydrophone, settings);
  if (!search.is_noted(kSpeed)) require_open_gate(hydrophone, search, settings.gate.speed, mission.search_speed);
}

}  // namespace

SoundSettings read_hydrophone(TableReader hydrophone, TableReader search, const config::Mission& mission) {
  SoundSettings settings = preset_named_by(hydrophone);
  settings.calibration = read_calibration(hydrophone);
  read_overrides(hydrophone, settings);
  read_channels(hydrophone, settings);
  settings.detection_threshold = mission.detection_threshold;
  if (is_anything_noted(hydrophone) || search.is_noted(kThreshold)) return settings;
  const SettingsFault fault = check(settings);
  if (fault == SettingsFault::kThreshold) {
    search.problem(kThreshold, to_string(fault));
  } else if (fault != SettingsFault::kNone) {
    hydrophone.problem(key_of(fault), reason_of(fault, settings));
  } else {
    require_hearing(hydrophone, search, settings, mission);
  }
  return settings;
}

Duration longest_silence_of(const SoundSettings& settings) {
  constexpr Hertz kAnyRate{12'000};  // the filters' times hardly depend on it
  detector::ListeningPlan plan;
  if (make_plan(settings, kAnyRate, plan) != Status::kOk) return {};
  const double quarter_s = static_cast<double>(plan.quarter) / plan.low_rate.value;
  const auto quarters = static_cast<double>(plan.settling_quarters + 2 * detector::kQuarters);
  return {std::llround(1e6 * (plan.delay_s + quarters * quarter_s))};
}

}  // namespace earshot::host
