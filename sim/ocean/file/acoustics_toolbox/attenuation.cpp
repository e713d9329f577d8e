#include "sim/ocean/file/acoustics_toolbox/attenuation.hpp"

#include <numbers>

namespace earshot::ocean::acoustics_toolbox {

double decibels_per_wavelength(double value, AttenuationUnit unit, Hertz frequency, MetersPerSecond sound_speed) {
  constexpr double kDecibelsPerNeper = 20.0 / std::numbers::ln10;
  const double wavelength_m = sound_speed.value / frequency.value;
  switch (unit) {
    case AttenuationUnit::kNepersPerMeter:
      return kDecibelsPerNeper * value * wavelength_m;
    case AttenuationUnit::kDecibelsPerMeter:
      return value * wavelength_m;
    case AttenuationUnit::kDecibelsPerMeterKilohertz:
      return value * sound_speed.value / 1000.0;
    case AttenuationUnit::kDecibelsPerWavelength:
      return value;
    case AttenuationUnit::kQuality:
      return value > 0.0 ? kDecibelsPerNeper * std::numbers::pi / value : 0.0;
    case AttenuationUnit::kLoss:
      return kDecibelsPerNeper * 2.0 * std::numbers::pi * value;
  }
  return value;
}

double thorp_db_per_km(Hertz frequency) {
  const double khz = frequency.value / 1000.0;
  const double squared = khz * khz;
  return 0.0033 + 0.11 * squared / (1.0 + squared) + 44.0 * squared / (4100.0 + squared) + 0.0003 * squared;
}

}  // namespace earshot::ocean::acoustics_toolbox
