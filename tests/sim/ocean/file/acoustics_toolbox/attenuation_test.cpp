#include "sim/ocean/file/acoustics_toolbox/attenuation.hpp"

#include <gtest/gtest.h>

namespace earshot::ocean::acoustics_toolbox {
namespace {

// By hand, of 1 Np = 8.685889638 dB.
constexpr double kRounding = 1e-8;

TEST(Attenuation, OfEachUnitIsTurnedIntoDecibelsPerWavelength) {
  const Hertz frequency{150.0};
  const MetersPerSecond speed{1500.0};  // a wavelength of 10 m
  EXPECT_NEAR(decibels_per_wavelength(0.01, AttenuationUnit::kNepersPerMeter, frequency, speed), 0.8685889638, kRounding);
  EXPECT_NEAR(decibels_per_wavelength(0.05, AttenuationUnit::kDecibelsPerMeter, frequency, speed), 0.5, kRounding);
  EXPECT_NEAR(decibels_per_wavelength(0.3, AttenuationUnit::kDecibelsPerMeterKilohertz, frequency, speed), 0.45, kRounding);
  EXPECT_EQ(decibels_per_wavelength(0.7, AttenuationUnit::kDecibelsPerWavelength, frequency, speed), 0.7);
  EXPECT_NEAR(decibels_per_wavelength(50.0, AttenuationUnit::kQuality, frequency, speed), 0.5457505415, kRounding);
  EXPECT_EQ(decibels_per_wavelength(0.0, AttenuationUnit::kQuality, frequency, speed), 0.0);
  EXPECT_NEAR(decibels_per_wavelength(0.01, AttenuationUnit::kLoss, frequency, speed), 0.5457505415, kRounding);
}

TEST(Attenuation, ThorpsFormulaAtAKilohertz) {
  EXPECT_NEAR(thorp_db_per_km(Hertz{1000.0}), 0.0693290905, 1e-9);  // 0.0033 + 0.055 + 44/4101 + 0.0003
}

}  // namespace
}  // namespace earshot::ocean::acoustics_toolbox
