#pragma once

#include "firmware/core/random.hpp"
#include "firmware/core/units.hpp"
#include "sim/hydrophone/normal_deviates.hpp"
#include "sim/ocean/band.hpp"

namespace earshot::hydrophone {

/// The frequency from which the simulated noise falls, by 6 dB an octave: about where the noise of distant ships does. Below it is level.
inline constexpr Hertz kNoiseCorner{20.0};

/// Share of a first-order low-pass noise's power that lies in a band.
///
///   share = 2/pi [atan(k tan(pi f2 / fs)) - atan(k tan(pi f1 / fs))],   k = (1 + a) / (1 - a),   a = exp(-2 pi fc / fs)
///
/// the integral of its density (1 - a^2) / (1 - 2 a cos w + a^2), exact for the sampled noise.
/// @param band  0 <= f1 < f2 <= fs / 2
/// @param corner, sample_rate  fc, fs
/// Oracle: AmbientNoise.HasTheShareOfItsPowerInABandThatIntegrationGives
[[nodiscard]] double share_in_band(ocean::Band band, Hertz corner, Hertz sample_rate);

/// Gaussian noise of the sea at one hydrophone, coloured: x[n] = a x[n-1] + g w[n], w white. Its level in the band is exact.
/// Oracle: AmbientNoise.*
class AmbientNoise {
 public:
  /// @param band_level  in the band, dB re 1 uPa
  AmbientNoise(Decibels band_level, ocean::Band band, Hertz sample_rate, Pcg32 random);

  /// The next sample, uPa.
  [[nodiscard]] double next() {
    last_ = feedback_ * last_ + gain_ * normal_.next();
    return last_;
  }

 private:
  NormalDeviates normal_;
  double feedback_;
  double gain_;
  double last_;
};

}  // namespace earshot::hydrophone
