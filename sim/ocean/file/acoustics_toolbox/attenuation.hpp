#pragma once

#include <cstdint>

#include "firmware/core/units.hpp"

namespace earshot::ocean::acoustics_toolbox {

/// What attenuation is given in, by the letter of the top options.
enum class AttenuationUnit : std::uint8_t {
  kNepersPerMeter,             ///< N
  kDecibelsPerMeter,           ///< M
  kDecibelsPerMeterKilohertz,  ///< F
  kDecibelsPerWavelength,      ///< W
  kQuality,                    ///< Q: quality factor; 0: no attenuation
  kLoss,                       ///< L: loss tangent
};

/// Attenuation in dB per wavelength.
///
///   1 Np = 20 / ln 10 dB;   wavelength = c / f;   Q: pi / Q Np per wavelength;   L: 2 pi L Np per wavelength
///
/// @param value  >= 0
/// Source: Jensen, Kuperman, Porter & Schmidt, Computational Ocean Acoustics, 2nd ed., 1.6; the Acoustics Toolbox' description of
/// environmental files. Oracle: Attenuation.*
[[nodiscard]] double decibels_per_wavelength(double value, AttenuationUnit unit, Hertz frequency, MetersPerSecond sound_speed);

/// Absorption of sea water, dB/km.
///
///   a = 0.0033 + 0.11 f^2 / (1 + f^2) + 44 f^2 / (4100 + f^2) + 0.0003 f^2,   f in kHz
///
/// Source: Jensen, Kuperman, Porter & Schmidt, Computational Ocean Acoustics, 2nd ed., Eq. 1.47 (Thorp's, brought up to date).
/// Oracle: Attenuation.ThorpsFormulaAtAKilohertz
[[nodiscard]] double thorp_db_per_km(Hertz frequency);

}  // namespace earshot::ocean::acoustics_toolbox
