#include "sim/ocean/water/sea_water.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace earshot::ocean {
namespace {

Radians degrees(double deg) {
  return Radians{deg * std::numbers::pi / 180.0};
}

TEST(SeaWater, MackenzieGivesItsPublishedCheckValue) {
  // Mackenzie 1981: T = 25 degC, S = 35, D = 1000 m, printed to 1 mm/s.
  EXPECT_NEAR(sound_speed_mackenzie({.temperature_c = 25.0, .salinity_psu = 35.0}, Meters{1000.0}).value, 1550.744, 0.0005);
}

TEST(SeaWater, MackenzieCountsSalinityAndTheDeepSea) {
  // By hand, 10 degC, 34 psu, 4000 m: 1448.96 + 45.91 - 5.304 + 0.2374 - 1.34 + 65.2 + 2.68 + 0.1025 - 0.456896.
  EXPECT_NEAR(sound_speed_mackenzie({.temperature_c = 10.0, .salinity_psu = 34.0}, Meters{4000.0}).value, 1555.989004, 1e-9);
  // At 0 degC, 35 psu and the deepest it was fitted for, 8000 m, what is left is 1448.96 + 130.4 + 10.72.
  EXPECT_NEAR(sound_speed_mackenzie({.temperature_c = 0.0, .salinity_psu = 35.0}, Meters{8000.0}).value, 1590.08, 1e-9);
}

TEST(SeaWater, UnescoGivesThePublishedCheckValue) {
  // UNESCO technical paper 44: 1731.995 m/s at S = 40, 40 degC (IPTS-68), 10000 dbar. Wong & Zhu rounded their ITS-90 coefficients; in this
  // corner A04 alone, printed to three digits, makes 3 mm/s.
  EXPECT_NEAR(sound_speed_unesco({.temperature_c = 40.0 / 1.00024, .salinity_psu = 40.0}, 10'000.0).value, 1731.995, 0.01);
}

TEST(SeaWater, UnescoAgreesWithTheSeawaterLibraryThroughoutTheOcean) {
  struct Row {
    double salinity_psu, temperature_c, pressure_dbar, sound_speed_mps;
  };
  // Python's seawater 3.3.5, svel: the 1977 coefficients on the IPTS-68 scale.
  for (const Row& row :
       {Row{35.0, 0.0, 0.0, 1449.138828129909}, Row{35.0, 10.0, 0.0, 1489.83094161936}, Row{0.0, 20.0, 0.0, 1482.3580433507882},
        Row{35.0, 4.0, 1000.0, 1483.0792667509663}, Row{34.7, 2.0, 4000.0, 1524.926435482019}, Row{38.5, 13.5, 2000.0, 1539.1362852646512},
        Row{36.0, 28.0, 0.0, 1542.3844548294653}, Row{34.0, -1.8, 500.0, 1447.4661549604446}}) {
    const SeaWater water{.temperature_c = row.temperature_c, .salinity_psu = row.salinity_psu};
    EXPECT_NEAR(sound_speed_unesco(water, row.pressure_dbar).value, row.sound_speed_mps, 0.005);  // rounding again, milder water
  }
}

TEST(SeaWater, UnescoIsCloseToTeos10) {
  struct Row {
    double latitude_deg, temperature_c, salinity_psu, depth_m, sound_speed_mps;
  };
  // Debian's python3-gsw 3.6.16: gsw.sound_speed at 30 degW. Chen & Millero errs by up to 0.6 m/s at depth (Dushaw et al., J. Acoust. Soc.
  // Am. 93 (1993) 255).
  for (const Row& row :
       {Row{45, 10, 35, 0, 1489.818}, Row{45, 4, 35, 1000, 1482.987}, Row{0, 25, 36, 100, 1536.965}, Row{45, 13.5, 38.5, 2000, 1539.200}}) {
    const SeaWater water{.temperature_c = row.temperature_c, .salinity_psu = row.salinity_psu};
    const double pressure = pressure_dbar(Meters{row.depth_m}, degrees(row.latitude_deg));
    EXPECT_NEAR(sound_speed_unesco(water, pressure).value, row.sound_speed_mps, 0.6) << "at " << row.depth_m << " m";
  }
}

TEST(SeaWater, PressureGivesSaundersCheckValue) {
  // Saunders 1981: 7500.00 dbar at 7321.45 m and 30 degN; the depth is printed to 1 cm, which is 0.01 dbar.
  EXPECT_NEAR(pressure_dbar(Meters{7321.45}, degrees(30.0)), 7500.0, 0.01);
  EXPECT_EQ(pressure_dbar(Meters{0.0}, degrees(30.0)), 0.0);
}

TEST(SeaWater, PressureAtThePolesIsThatOfHeavierGravity) {
  // By hand of Saunders' formula: 10 000 dbar stand under 0.98883e4 - 221 m at the poles and 0.99408e4 - 221 m on the equator.
  EXPECT_NEAR(pressure_dbar(Meters{9667.3}, degrees(90.0)), 10'000.0, 1e-6);
  EXPECT_NEAR(pressure_dbar(Meters{9667.3}, degrees(-90.0)), 10'000.0, 1e-6);
  EXPECT_NEAR(pressure_dbar(Meters{9719.8}, degrees(0.0)), 10'000.0, 1e-6);
  // UNESCO technical paper 44 prints 9674.23 m and 9725.47 m for them, by another equation: within the 0.1 % that are promised.
  EXPECT_NEAR(pressure_dbar(Meters{9674.23}, degrees(90.0)), 10'000.0, 10.0);
  EXPECT_NEAR(pressure_dbar(Meters{9725.47}, degrees(0.0)), 10'000.0, 10.0);
}

TEST(SeaWater, SoundSpeedTakesLatitudeForPressureInTheOneFormulaAndNotInTheOther) {
  const SeaWater abyss{.temperature_c = 2.0, .salinity_psu = 34.7};
  const auto at_latitude = [&](double latitude_deg, SoundSpeedFormula formula) {
    return sound_speed_of(abyss, Meters{4000.0}, degrees(latitude_deg), formula).value;
  };
  // At 4000 m and 2 degC sound speed rises by 0.0175 m/s to a dbar; the equator's pressure is 0.53 % of 4070 dbar, 21.5 dbar, less.
  EXPECT_NEAR(at_latitude(90.0, SoundSpeedFormula::kUnesco) - at_latitude(0.0, SoundSpeedFormula::kUnesco), 0.376, 0.01);
  EXPECT_EQ(at_latitude(90.0, SoundSpeedFormula::kMackenzie), at_latitude(0.0, SoundSpeedFormula::kMackenzie));
}

TEST(SeaWater, AbsorptionAgreesWithAnIndependentTool) {
  // arlpy 1.9.3; its manual prints the first, 10.71 dB/km. Its pure-water term errs below 20 degC, so cold water stands here at frequencies
  // where that term does not count (under 1e-4 of the whole).
  struct Row {
    double frequency_hz, temperature_c, salinity_psu, depth_m, ph, absorption_db_per_km;
  };
  for (const Row& row : {Row{50000, 27, 35, 10, 8.1, 10.710332974759083}, Row{1000, 4, 35, 1000, 8.0, 0.061028996188322096},
                         Row{100, 10, 34, 0, 7.9, 0.0008648744129493532}, Row{20, 4, 34.5, 1000, 7.8, 3.6289593844525655e-05},
                         Row{1000, 25, 36, 50, 8.2, 0.0643545020566291}}) {
    const SeaWater water{.temperature_c = row.temperature_c, .salinity_psu = row.salinity_psu, .acidity_ph_nbs = row.ph};
    EXPECT_NEAR(absorption_db_per_km(water, Meters{row.depth_m}, Hertz{row.frequency_hz}), row.absorption_db_per_km,
                1e-4 * row.absorption_db_per_km);
  }
}

TEST(SeaWater, AbsorptionOfHighFrequenciesInTheDeepSeaAgreesWithAnIndependentTool) {
  struct Row {
    double frequency_hz, temperature_c, salinity_psu, depth_m, ph, absorption_db_per_km;
  };
  // Python's echopype 0.11.1, calc_absorption, "FG"; it takes the paper's depth for its `pressure`. Below 3500 m the paper extrapolates.
  for (const Row& row : {Row{10e3, 13.5, 38.5, 3000, 8.1, 0.6721987309824323}, Row{38e3, 4, 35, 2000, 7.9, 8.030329436214727},
                         Row{100e3, 4, 35, 4990, 8.0, 13.829337041554716}, Row{120e3, 2, 34.7, 4000, 7.8, 17.111649390604878},
                         Row{300e3, 2, 34.7, 3500, 7.8, 49.21621522725192}, Row{400e3, 22, 35, 1200, 8.0, 114.12420461265643},
                         Row{500e3, -1.5, 34.5, 1500, 8.0, 141.07385220530037}, Row{500e3, 25, 36, 1500, 8.1, 144.74146092418795},
                         Row{1e6, 1.5, 34.7, 6000, 7.8, 369.1052814362739}}) {
    const SeaWater water{.temperature_c = row.temperature_c, .salinity_psu = row.salinity_psu, .acidity_ph_nbs = row.ph};
    EXPECT_NEAR(absorption_db_per_km(water, Meters{row.depth_m}, Hertz{row.frequency_hz}), row.absorption_db_per_km,
                1e-12 * row.absorption_db_per_km)  // rounding
        << row.frequency_hz << " Hz at " << row.depth_m << " m";
  }
}

TEST(SeaWater, AbsorptionOfPureWaterIsContinuousAtTwentyDegrees) {
  // At 100 MHz without salt pure water is all: at 20 degC the paper's two polynomials make 2.201e-4 and 2.2e-4 dB/km/kHz^2, by hand.
  const auto of_fresh_water = [](double temperature_c) {
    return absorption_db_per_km({.temperature_c = temperature_c, .salinity_psu = 0.0}, Meters{0.0}, Hertz{100e6});
  };
  EXPECT_NEAR(of_fresh_water(20.0), 2.201e6, 1.0);
  EXPECT_NEAR(of_fresh_water(std::nextafter(20.0, 21.0)), 2.2e6, 1.0);
}

TEST(SeaWater, AbsorptionAgreesWithAinslieAndMcColm) {
  // Their shorter formula lies within 10 % of Francois & Garrison in the ocean (Ainslie & McColm, J. Acoust. Soc. Am. 103 (1998) 1671).
  const auto ainslie = [](double t, double s, double ph, double z_km, double f) {
    const double f1 = 0.78 * std::sqrt(s / 35.0) * std::exp(t / 26.0);
    const double f2 = 42.0 * std::exp(t / 17.0);
    return 0.106 * f1 * f * f / (f1 * f1 + f * f) * std::exp((ph - 8.0) / 0.56) +
           0.52 * (1.0 + t / 43.0) * (s / 35.0) * f2 * f * f / (f2 * f2 + f * f) * std::exp(-z_km / 6.0) +
           0.00049 * f * f * std::exp(-(t / 27.0 + z_km / 17.0));
  };
  for (const double frequency_khz : {0.1, 0.3, 1.0, 3.0, 10.0, 40.0, 100.0, 300.0}) {
    for (const double temperature_c : {-1.5, 4.0, 8.0, 20.0}) {
      for (const double depth_km : {1.0, 2.0, 3.0}) {
        const SeaWater water{.temperature_c = temperature_c, .salinity_psu = 34.7, .acidity_ph_nbs = 8.0};
        const double theirs = ainslie(temperature_c, 34.7, 8.0, depth_km, frequency_khz);
        EXPECT_NEAR(absorption_db_per_km(water, Meters{1000.0 * depth_km}, Hertz{1000.0 * frequency_khz}), theirs, 0.1 * theirs)
            << frequency_khz << " kHz, " << temperature_c << " degC, " << depth_km << " km";
      }
    }
  }
}

}  // namespace
}  // namespace earshot::ocean
