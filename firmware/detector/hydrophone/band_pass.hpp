#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware/core/units.hpp"
#include "firmware/detector/hydrophone/calibration.hpp"

namespace earshot::detector {

/// Second-order section H(z) = gain (1 - z^-2) / (1 + a1 z^-1 + a2 z^-2).
struct Section {
  float gain = 0.0F;
  float a1 = 0.0F;
  float a2 = 0.0F;
};

inline constexpr std::size_t kSections = 8;
using BandPassDesign = std::array<Section, kSections>;

/// A Chebyshev band-pass, 16th order, +-0.025 dB. Its ripple ends just inside the band, so that it passes as much white noise as a filter
/// with upright walls at the band's ends would: the level of noise and that of a tone are both right.
/// @param rate  more than twice the band's high end
/// Source: Oppenheim & Schafer, 3rd ed., ch. 7 and app. B: analog prototype, band-pass transformation, bilinear with the ends pre-warped.
/// Oracle: BandPass.AnswersAsScipysFilterDoes
[[nodiscard]] BandPassDesign design_band_pass(Band band, Hertz rate);

/// One channel's memory of a band-pass (transposed direct form II).
class BandPass {
 public:
  void clear() { state_ = {}; }
  /// Each sample in turn, in its place.
  void run(const BandPassDesign& design, std::span<float> samples);

 private:
  struct Memory {
    float first = 0.0F;
    float second = 0.0F;
  };
  std::array<Memory, kSections> state_{};
};

/// What a band-pass does to the statistics of noise.
struct BandPassResponse {
  double noise_width_hz = 0.0;  ///< of the upright filter that passes as much white noise
  double delay = 0.0;           ///< samples: centre of gravity of its impulse response's energy
  double settling = 0.0;        ///< samples after which no more than 1e-4 of an impulse's energy is to come
  double degrees_of_freedom = 0.0;
};

/// Measured on the impulse response of the filter as it runs.
///
///   degrees of freedom = 2 mean^2 / variance of the power of white noise over `count` samples
///                      = count^2 r0^2 / sum over |k| < count of (count - |k|) rk^2,   r its autocorrelation
///
/// about twice the band's width times the time. Source: Welch 1967 / Satterthwaite 1946 (first two moments of a chi-square).
/// Oracle: BandPass.GivesNoiseAsManyDegreesOfFreedomAsWereCounted
[[nodiscard]] BandPassResponse measure(const BandPassDesign& design, Hertz rate, std::size_t count);

}  // namespace earshot::detector
