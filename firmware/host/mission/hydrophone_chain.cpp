#include "firmware/host/mission/hydrophone_chain.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/host/mission/rule_words.hpp"
#include "firmware/messages/hydrophone_block.hpp"

namespace earshot::host {
namespace {

/// Of Gaussian noise one sample in 600 is further from zero than 10 dB above its root mean square: of 1000 samples a second, hardly one
/// second has none.
constexpr Decibels kPeaksOfNoise{10.0};
/// A sine's peak over its root mean square.
constexpr Decibels kPeakOfTone{3.0};
/// The detector takes what has no more than twice the power of the ADC's own noise for a hydrophone that is not connected.
constexpr Decibels kOpen{3.0};
// In any band of 1 Hz to 1 kHz that a detector has, in any sea: under Arctic ice, and beside a ship in a storm.
constexpr Decibels kQuietestSea{20.0};
constexpr Decibels kLoudestSea{150.0};

std::string tenths(Decibels level) {
  return shortly(std::round(10.0 * level.value) / 10.0);
}

}  // namespace

ChainRoom room_of(const detector::SoundSettings& settings) {
  const Decibels noise = is_finite(settings.expected_noise.value) ? settings.expected_noise : kQuietestSea;
  const Decibels peaks = std::max(kPeaksOfNoise, settings.detection_threshold + kPeakOfTone);
  const Hertz lowest_rate = std::max(messages::kLowestSampleRate, detector::kLeastRateOverBand * settings.band.high);
  return {.full_scale = full_scale_level(settings.calibration, Decibels{}),
          .least_full_scale = noise + peaks,
          .adc_noise_at_highest_rate = adc_noise_level(settings.calibration, Decibels{}, messages::kHighestSampleRate, settings.band),
          .adc_noise_at_lowest_rate = adc_noise_level(settings.calibration, Decibels{}, lowest_rate, settings.band),
          .lowest_rate = lowest_rate};
}

std::string reason_for_deafness(const detector::SoundSettings& settings) {
  const ChainRoom room = room_of(settings);
  const bool is_known = is_finite(settings.expected_noise.value);
  if (room.full_scale < room.least_full_scale) {
    return "the chain would clip all the time: a sample of full scale is " + tenths(room.full_scale) + " dB re 1 uPa, and " +
           (is_known ? "the noise that is expected" : "the noise of the quietest sea") +
           " with a source at the detection threshold needs " + tenths(room.least_full_scale) +
           ": it needs less gain_db or a greater full_scale_v";
  }
  const Decibels loudest = is_known ? settings.expected_noise : kLoudestSea;
  if (room.adc_noise_at_highest_rate + kOpen > loudest) {
    return "the chain would hear nothing but its ADC, whose own noise in the band is " + tenths(room.adc_noise_at_highest_rate) +
           " dB re 1 uPa at " + shortly(messages::kHighestSampleRate.value) + " Hz and more at every other rate, and " +
           (is_known ? "the noise that is expected is " : "the loudest sea has ") + tenths(loudest) + ": it needs more gain_db or adc_bits";
  }
  return {};
}

}  // namespace earshot::host
