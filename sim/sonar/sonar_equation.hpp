#pragma once

#include "firmware/core/units.hpp"

namespace earshot::sonar {

/// Passive sonar equation at the hydrophone.
///
///   SNR = SL - TL - N
///
/// @param source_level        SL, dB re 1 uPa @ 1 m
/// @param transmission_loss   TL, dB re 1 m
/// @param noise_level         N in the detector's band, dB re 1 uPa
/// @return SNR in dB; NaN where an input is NaN, as the loss is where there is no water
/// Source: Clark et al. 2022, Eq. 1.   Oracle: SonarEquation.GivesTenDecibelsAtNinetyOfLoss
[[nodiscard]] constexpr Decibels signal_to_noise(Decibels source_level, Decibels transmission_loss, Decibels noise_level) {
  return source_level - transmission_loss - noise_level;
}

}  // namespace earshot::sonar
