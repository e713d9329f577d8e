#pragma once

#include <string>

#include "firmware/core/units.hpp"
#include "firmware/detector/hydrophone/settings.hpp"

namespace earshot::host {

/// What a chain leaves for the sea between the ADC's own noise and full scale, as far as it can be judged before a block has come: by the
/// fixed gain alone, at the sample rates that blocks may have. All in dB re 1 uPa.
struct ChainRoom {
  Decibels full_scale;                 ///< of a sample of 1.0 (peak)
  Decibels least_full_scale;           ///< below, the expected noise clips, or a source that just reaches the detection threshold
  Decibels adc_noise_at_highest_rate;  ///< in the band: the least that it can be
  Decibels adc_noise_at_lowest_rate;   ///< in the band: the most that it can be
  Hertz lowest_rate;                   ///< that blocks may have and at which the band is heard
};

/// @pre check(settings) finds no fault. Where no noise is expected, `least_full_scale` is that of the quietest sea.
[[nodiscard]] ChainRoom room_of(const detector::SoundSettings& settings);

/// Why the chain hears nothing, at whatever rate its blocks come and, where no noise is expected, in whatever sea; empty where it may hear.
/// @pre as room_of()
[[nodiscard]] std::string reason_for_deafness(const detector::SoundSettings& settings);

}  // namespace earshot::host
