#pragma once

#include <variant>
#include <vector>

#include "firmware/core/units.hpp"

namespace earshot::ocean {

/// Munk's canonical deep-sea sound-speed profile.
///
///   c(z) = c1 [1 + eps (eta + exp(-eta) - 1)],   eta = 2 (z - z1) / B
///
/// Source: Munk, "Sound channel in an exponentially stratified ocean", J. Acoust. Soc. Am. 55 (1974) 220, with the constants of Clark et
/// al. 2022. Oracle: MunkProfile.AgreesWithAnIndependentTable
struct MunkProfile {
  MetersPerSecond axis_sound_speed;  ///< c1 > 0
  Meters axis_depth;                 ///< z1, positive down
  Meters scale;                      ///< B > 0
  double perturbation = 0.0;         ///< eps >= 0
};

/// Sound speed at given depths, linear between them, constant beyond the first and the last.
struct TabulatedProfile {
  std::vector<double> depth_m;          ///< strictly increasing, at least one
  std::vector<double> sound_speed_mps;  ///< as many, each > 0
};

using SoundSpeedProfile = std::variant<MunkProfile, TabulatedProfile>;

/// @param depth  positive down
[[nodiscard]] MetersPerSecond sound_speed(const SoundSpeedProfile& profile, Meters depth);

}  // namespace earshot::ocean
