#pragma once

#include <cstdint>
#include <limits>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/detector/hydrophone/calibration.hpp"

namespace earshot::detector {

/// Where the noise in the band is learnt from.
enum class NoiseReference : std::uint8_t {
  kPast,    ///< the band itself, over the floor's window: for calls with pauses
  kFlanks,  ///< the bands beside it, over the same window: for a tone that never ends
};

/// A detection needs the threshold reached in `m` of the last `n` estimates; 1 of 1: every estimate that reaches it.
struct MOfN {
  std::uint8_t m = 1;
  std::uint8_t n = 1;
  friend constexpr bool operator==(const MOfN&, const MOfN&) = default;
};

/// Above these the vehicle hears itself, and the detector says so and measures nothing.
struct SelfNoiseGate {
  MetersPerSecond speed{std::numeric_limits<double>::infinity()};  ///< through the water
  double thruster_rpm = std::numeric_limits<double>::infinity();
};

/// What the detector listens for.
struct SoundSettings {
  Calibration calibration;
  Band band;
  Duration integration_time = Duration::seconds(1);  ///< about as long as a pulse; estimates come four times as often
  Duration floor_window = Duration::seconds(120);    ///< the noise floor's memory
  NoiseReference noise_reference = NoiseReference::kPast;
  Decibels detection_threshold{10.0};  ///< DT
  MOfN m_of_n;
  Duration longest_pause = Duration::milliseconds(1500);              ///< within one detection
  Decibels expected_noise{std::numeric_limits<double>::quiet_NaN()};  ///< ambient in the band, dB re 1 uPa; NaN: not known
  SelfNoiseGate gate;
  std::uint8_t channels = 0xFF;  ///< one bit for each that is listened to, the lowest for the first
};

enum class SettingsFault : std::uint8_t {
  kNone,
  kBand,             ///< not 1 Hz <= low < high, high 10 Hz to 1 kHz, width at least 1 Hz and a twentieth of the high end
  kFlanks,           ///< no room beside the band for the bands that the noise is learnt from
  kIntegrationTime,  ///< not 0.1 s to 60 s, or fewer than two periods of the band's width
  kFloorWindow,      ///< not 16 to kFloorLevels integration times
  kThreshold,        ///< not from -10 to 60 dB
  kMOfN,             ///< not 1 <= m <= n <= 32
  kPause,            ///< not 0 to 60 s
  kExpectedNoise,    ///< not -100 to 300 dB re 1 uPa, where given
  kGate,             ///< not positive
  kChannels,         ///< none
  kCalibration,      ///< see check(calibration ...)
};

[[nodiscard]] const char* to_string(SettingsFault fault);

/// All that can be judged before a sample has come: the chain without the block's gain and sample rate, which a block brings.
[[nodiscard]] SettingsFault check(const SoundSettings& settings);

/// Lowest sample rate at which a band can be heard: so many times its high end. (A block of less is refused: kRateTooLow.)
inline constexpr double kLeastRateOverBand = 2.2;

/// The part of a band that can be heard at a sample rate; the same band where that is all of it. May be no band at all: check().
[[nodiscard]] Band audible_part(Band band, Hertz sample_rate);

// Presets. Calibration, expected noise and gate are the vehicle's own: set them.

/// Fin whale: pulses of about 1 s that fall through 20 Hz, one in about 15 s.
[[nodiscard]] SoundSettings fin_whale();
/// North-eastern Pacific blue whale: A and B calls of 10 to 20 s at 14 to 17 Hz, one in about a minute.
[[nodiscard]] SoundSettings blue_whale();
/// Antarctic blue whale: Z calls of 20 s, from 28 Hz down to 18 Hz, one in about a minute.
[[nodiscard]] SoundSettings antarctic_blue_whale();
/// A tone about 20 Hz that never ends.
[[nodiscard]] SoundSettings continuous_tone();

}  // namespace earshot::detector
