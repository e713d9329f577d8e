#pragma once

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::messages {

/// A sound that the vehicle's detector heard from its beginning to its end. It is told to people and steers nothing.
struct SoundDetection {
  Time begin;
  Duration duration;
  Decibels level;           ///< of its loudest integration time, signal and noise in the band, dB re 1 uPa
  Decibels snr;             ///< of the same
  bool is_clipped = false;  ///< samples of it were at full scale: it was louder than told
  friend constexpr bool operator==(const SoundDetection&, const SoundDetection&) = default;
};

}  // namespace earshot::messages
