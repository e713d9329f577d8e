#pragma once

#include <cstdint>

#include "firmware/core/units.hpp"

namespace earshot::ocean {

/// A sample of sea water.
struct SeaWater {
  double temperature_c;         ///< in situ, ITS-90
  double salinity_psu;          ///< practical salinity
  double acidity_ph_nbs = 8.0;  ///< only absorption asks for it
};

/// Mackenzie's nine-term equation.
///
///   c = 1448.96 + 4.591 T - 5.304e-2 T^2 + 2.374e-4 T^3 + 1.340 (S - 35) + 1.630e-2 D + 1.675e-7 D^2 - 1.025e-2 T (S - 35) - 7.139e-13 T
///   D^3
///
/// Fitted for 2 to 30 degC, 25 to 40 psu and 0 to 8000 m (standard error 0.07 m/s); evaluated, not checked, outside.
/// Source: Mackenzie, J. Acoust. Soc. Am. 70 (1981) 807.   Oracle: SeaWater.MackenzieGivesItsPublishedCheckValue
[[nodiscard]] MetersPerSecond sound_speed_mackenzie(const SeaWater& water, Meters depth);

/// The UNESCO equation (Chen & Millero) in ITS-90 coefficients.
///
/// Fitted for 0 to 40 degC, 0 to 40 psu and 0 to 1000 bar; evaluated, not checked, outside (polar water is colder by up to 2 degC).
/// @param pressure_dbar  above the atmosphere's, 0 at the surface
/// Source: Chen & Millero, J. Acoust. Soc. Am. 62 (1977) 1129; Wong & Zhu, J. Acoust. Soc. Am. 97 (1995) 1732.
/// Oracle: SeaWater.UnescoGivesThePublishedCheckValue, SeaWater.UnescoIsCloseToTeos10
[[nodiscard]] MetersPerSecond sound_speed_unesco(const SeaWater& water, double pressure_dbar);

/// Pressure of standard sea water (0 degC, 35 psu) above the atmosphere's, dbar, within 0.1 % of a real column's.
///
///   D = (1 - c1) p - c2 p^2,   c1 = (5.92 + 5.25 sin^2 latitude) 1e-3,   c2 = 2.21e-6
///
/// @param depth  0 to 12 km
/// Source: Saunders, J. Phys. Oceanogr. 11 (1981) 573.   Oracle: SeaWater.PressureGivesSaundersCheckValue
[[nodiscard]] double pressure_dbar(Meters depth, Radians latitude);

enum class SoundSpeedFormula : std::uint8_t { kUnesco, kMackenzie };

/// @param latitude  enters by pressure: 0.26 % of it between equator and pole, 0.2 m/s at 4000 m
[[nodiscard]] MetersPerSecond sound_speed_of(const SeaWater& water, Meters depth, Radians latitude, SoundSpeedFormula formula);

/// Absorption of sound, dB/km: boric acid, magnesium sulphate and pure water.
///
/// Good to 5 % for 10 to 500 kHz, -2 to 22 degC, 30 to 35 psu and 0 to 3500 m, and to 10 % for 0.2 to 10 kHz and wider waters; below, only
/// the boric acid counts and its strength is known to some 20 %.
/// @param frequency  > 0
/// Source: Francois & Garrison, J. Acoust. Soc. Am. 72 (1982) 896 and 1879.
/// Oracle: SeaWater.AbsorptionAgreesWithAnIndependentTool, SeaWater.AbsorptionAgreesWithAinslieAndMcColm
[[nodiscard]] double absorption_db_per_km(const SeaWater& water, Meters depth, Hertz frequency);

}  // namespace earshot::ocean
