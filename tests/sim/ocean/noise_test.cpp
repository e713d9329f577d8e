#include "sim/ocean/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace earshot::ocean {
namespace {

TEST(Noise, WenzCurvesGiveTheValuesWorkedByHand) {
  // 100 Hz, no wind, middling shipping: turbulence 47.00, shipping 67.16, wind 42.04, thermal -35 dB; their powers add to 67.22 dB.
  EXPECT_NEAR(wenz_spectral_density({.shipping = 0.5, .wind_speed_mps = 0.0}, Hertz{100.0}).value, 67.22, 0.005);
  // 1 Hz: turbulence alone, 17 + 90.
  EXPECT_NEAR(wenz_spectral_density({.shipping = 0.0, .wind_speed_mps = 0.0}, Hertz{1.0}).value, 107.0, 0.01);
}

TEST(Noise, WenzCurvesAgreeWithTheNavysTables) {
  // NUSC TD 7265 (1984) tabulates the same curves from other measurements, which scatter by this much; the furthest
  // apart is the hump of shipping at 50 Hz, by 5.2 dB.
  const double tolerance_db = 6.0;
  EXPECT_NEAR(wenz_spectral_density({.shipping = 0.0, .wind_speed_mps = 0.0}, Hertz{10.0}).value, 76.0, tolerance_db);       // turbulence
  EXPECT_NEAR(wenz_spectral_density({.shipping = 0.0, .wind_speed_mps = 0.0}, Hertz{100'000.0}).value, 25.0, tolerance_db);  // thermal
  EXPECT_NEAR(wenz_spectral_density({.shipping = 0.5, .wind_speed_mps = 0.0}, Hertz{50.12}).value, 77.3, tolerance_db);      // level 4
  EXPECT_NEAR(wenz_spectral_density({.shipping = 0.0, .wind_speed_mps = 7.0}, Hertz{1000.0}).value, 62.4, tolerance_db);     // sea state 3
  EXPECT_NEAR(wenz_spectral_density({.shipping = 0.0, .wind_speed_mps = 7.0}, Hertz{10'000.0}).value, 46.6, tolerance_db);   // sea state 3
}

TEST(Noise, RainAddsItsTableBetween631HzAnd16KHzOnly) {
  const NoiseSources calm{.shipping = 0.0, .wind_speed_mps = 0.0, .rain = Rain::kNone};
  NoiseSources wet = calm;
  wet.rain = Rain::kHeavy;
  EXPECT_NEAR(wenz_spectral_density(wet, Hertz{1000.0}).value, 82.0, 0.01);  // the others lie 30 dB below
  wet.rain = Rain::kIntermediate;
  EXPECT_NEAR(wenz_spectral_density(wet, Hertz{10'000.0}).value, 62.8, 0.01);
  EXPECT_EQ(wenz_spectral_density(wet, Hertz{600.0}), wenz_spectral_density(calm, Hertz{600.0}));
  EXPECT_EQ(wenz_spectral_density(wet, Hertz{16'000.0}), wenz_spectral_density(calm, Hertz{16'000.0}));
}

TEST(Noise, TableIsLinearInTheLogarithmOfFrequencyAndConstantBeyondItsEnds) {
  const NoiseTable table{.frequency_hz = {10.0, 1000.0}, .level_db_re_1upa2_per_hz = {90.0, 60.0}};
  EXPECT_NEAR(spectral_density(table, Hertz{100.0}).value, 75.0, 1e-12);
  EXPECT_EQ(spectral_density(table, Hertz{1.0}).value, 90.0);
  EXPECT_EQ(spectral_density(table, Hertz{5000.0}).value, 60.0);
}

TEST(Noise, LevelOfWhiteNoiseIsItsDensityAndTenLogBandwidth) {
  const auto white = [](Hertz) { return Decibels{80.0}; };
  // The trapezoidal rule over f d(ln f) errs by (ln 2 / 1000)^2 / 12 of the whole.
  EXPECT_NEAR(band_level(white, {.low = Hertz{15.0}, .high = Hertz{25.0}}).value, 90.0, 1e-6);
}

TEST(Noise, LevelOfASlopingSpectrumIsItsIntegral) {
  const auto falling = [](Hertz f) { return Decibels{-20.0 * std::log10(f.value)}; };  // 1 / f^2: its integral is 1/low - 1/high
  EXPECT_NEAR(band_level(falling, {.low = Hertz{15.0}, .high = Hertz{30.0}}).value, 10.0 * std::log10(1.0 / 30.0), 1e-6);
}

}  // namespace
}  // namespace earshot::ocean
