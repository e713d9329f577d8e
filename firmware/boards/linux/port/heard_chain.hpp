#pragma once

#include <cstdint>

#include "firmware/core/units.hpp"
#include "firmware/detector/hydrophone/calibration.hpp"

namespace earshot::board {

/// With what a hydrophone is heard, as its blocks have it.
struct HeardChain {
  enum class Heard : std::uint8_t {
    kWell,
    kImpossibleChain,  ///< `fault` says why
    kRateTooLow,       ///< for the band
  };
  Heard heard = Heard::kWell;
  detector::CalibrationFault fault = detector::CalibrationFault::kNone;
  detector::Band band;
  Hertz sample_rate;
  std::uint8_t channels = 0;
  Decibels full_scale_level;  ///< of a sample of 1.0, dB re 1 uPa peak
  Decibels adc_noise_level;   ///< in the band, dB re 1 uPa
  double delay_s = 0.0;       ///< of the filters: measurements are dated by so much earlier
  friend constexpr bool operator==(const HeardChain&, const HeardChain&) = default;
};

}  // namespace earshot::board
