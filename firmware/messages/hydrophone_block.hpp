#pragma once

#include <cstdint>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::messages {

inline constexpr Hertz kLowestSampleRate{250};  ///< a fin whale's 20 Hz many times over
inline constexpr Hertz kHighestSampleRate{96'000};
inline constexpr std::int64_t kLastSample = std::int64_t{1} << 53;  ///< no ADC counts so far: 2974 years at 96 kHz
inline constexpr Decibels kHighestGain{200};                        ///< and the lowest, negative: no amplifier reaches either

/// What is said about a block of hydrophone samples. The samples go beside it as a span of floats: shares of the ADC's full scale, -1 to 1,
/// before any calibration; interleaved, as ADCs and sound files give them: one of each channel, then the next of each. They may be NaN.
/// Samples never enter the runtime.
struct HydrophoneBlock {
  Time time;                      ///< UTC: when the ADC took the first sample, as its sender says
  std::int64_t sequence = 0;      ///< counts the sender's blocks
  std::int64_t first_sample = 0;  ///< counts the samples of one channel; a gap is a dropout
  Hertz sample_rate;              ///< of each channel
  Decibels gain;                  ///< from hydrophone to ADC
  std::uint32_t samples_per_channel = 0;
  std::uint32_t overflow_count = 0;  ///< samples that the ADC clipped, of all channels together
  std::uint8_t channels = 0;
  friend constexpr bool operator==(const HydrophoneBlock&, const HydrophoneBlock&) = default;
};

}  // namespace earshot::messages
