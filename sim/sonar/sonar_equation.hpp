#pragma once

#include "firmware/core/status.hpp"
#include "firmware/core/units.hpp"

namespace earshot::sonar {

/// Passive sonar equation at the hydrophone.
///
///   SNR = SL - TL - N
///
/// @param source_level        SL, dB re 1 uPa @ 1 m
/// @param transmission_loss   TL, dB re 1 m
/// @param noise_level         N in the detector's band, dB re 1 uPa
/// @return SNR in dB; kOutOfRange if an input is not finite.
/// Source: Clark et al. 2022, Eq. 1.   Oracle: SonarEquation.GivesTenDecibelsAtNinetyOfLoss
[[nodiscard]] Result<Decibels> signal_to_noise(Decibels source_level, Decibels transmission_loss, Decibels noise_level);

}  // namespace earshot::sonar
