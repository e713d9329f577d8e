#pragma once

#include <cstddef>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/sonar/fan.hpp"
#include "sim/sonar/sonar_equation.hpp"

namespace earshot::sonar {

/// What decides whether a sound is heard.
struct Detector {
  Decibels source_level;         ///< dB re 1 uPa @ 1 m
  Decibels noise_level;          ///< in the detector's band, dB re 1 uPa
  Decibels detection_threshold;  ///< DT: the SNR that is needed
  Decibels fluctuation;          ///< sigma >= 0: standard deviation of the SNR, normal in dB; 0: none

  [[nodiscard]] Decibels snr(Decibels transmission_loss) const { return signal_to_noise(source_level, transmission_loss, noise_level); }
};

/// Probability that a fluctuating SNR is at or above the threshold.
///
///   P_d = Phi((SNR - DT) / sigma);   sigma = 0: 1 where SNR >= DT, else 0;   NaN for a NaN SNR
///
/// Source: Urick, Principles of Underwater Sound, 3rd ed., ch. 12 (signal excess and detection probability).
/// Oracle: DetectionProbability.FollowsTheTableOfTheNormalDistribution
[[nodiscard]] double detection_probability(Decibels snr, const Detector& detector);

/// Of every value of a fan. [n_bearing x n_range x n_depth]
[[nodiscard]] std::vector<float> detection_probabilities(const Fan& fan, const Detector& detector);

/// How far one radial is heard at one depth. Crossings of the threshold are found linearly in dB between ranges.
struct DetectionRange {
  double assured_m;   ///< heard at every range up to here; 0: not even at the first
  double furthest_m;  ///< heard here and nowhere beyond; 0: nowhere. The last range with water where it is heard there: maybe further
};

/// Whether a range of detection is the last that was computed: the sound may be heard further.
[[nodiscard]] inline bool is_heard_to_the_end(const Fan& fan, double range_m) {
  return range_m > fan.max_range().value - 1e-6 * fan.range_step.value;
}

/// For every bearing of a fan; NaN where the radial's first range has no water at that depth. Beyond a bank that reaches up to the
/// hydrophone's depth hearing may begin again: that ends `assured_m`, not `furthest_m`.
/// Oracle: DetectionRange.*
[[nodiscard]] std::vector<DetectionRange> detection_ranges(const Fan& fan, std::size_t depth, const Detector& detector);

}  // namespace earshot::sonar
