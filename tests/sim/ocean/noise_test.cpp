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

TEST(Noise, WenzCurvesOfWindAndHeavyShippingGiveTheValuesWorkedByHand) {
  // 1 kHz, 4 m/s: wind 50 + 15 - 40 lg 1.4 = 59.1549, shipping 30 - 60 lg 1.03 = 29.2298, turbulence 17 dB; together 59.1596 dB.
  EXPECT_NEAR(wenz_spectral_density({.shipping = 0.0, .wind_speed_mps = 4.0}, Hertz{1000.0}).value, 59.1596, 5e-5);
  // 50 Hz, heavy shipping: 50 + 26 lg 0.05 - 60 lg 0.08 = 81.9877, turbulence 56.0309, calm sea 37.8509 dB; together 81.9990 dB.
  EXPECT_NEAR(wenz_spectral_density({.shipping = 1.0, .wind_speed_mps = 0.0}, Hertz{50.0}).value, 81.9990, 5e-5);
  // 100 kHz, where the curves end: thermal 25 dB, wind 50 + 7.5 sqrt 9 + 40 - 40 lg 100.4 = 32.4306 dB; together 33.1520 dB.
  EXPECT_NEAR(wenz_spectral_density({.shipping = 1.0, .wind_speed_mps = 9.0}, Hertz{100'000.0}).value, 33.1520, 5e-5);
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

TEST(Noise, RainBeginsAndEndsWithItsTable) {
  const auto rain_at = [](Rain rain, double frequency_hz) {
    return wenz_spectral_density({.shipping = 0.0, .wind_speed_mps = 0.0, .rain = rain}, Hertz{frequency_hz}).value;
  };
  // The table's ends are 10^2.8 = 630.957 Hz and 10^4.2 = 15 848.93 Hz; the other noises lie 32 dB below the faintest, 0.003 dB of the sum.
  EXPECT_NEAR(rain_at(Rain::kIntermediate, 630.96), 79.8, 0.01);
  EXPECT_NEAR(rain_at(Rain::kModerate, 630.96), 80.9, 0.01);
  EXPECT_NEAR(rain_at(Rain::kHeavy, 630.96), 82.1, 0.01);
  EXPECT_NEAR(rain_at(Rain::kIntermediate, 15'848.9), 58.6, 0.01);
  EXPECT_NEAR(rain_at(Rain::kModerate, 15'848.9), 69.4, 0.01);
  EXPECT_NEAR(rain_at(Rain::kHeavy, 15'848.9), 76.7, 0.01);
  for (const double outside_hz : {630.95, 15'849.0}) {
    for (const Rain rain : {Rain::kIntermediate, Rain::kModerate, Rain::kHeavy})
      EXPECT_EQ(rain_at(rain, outside_hz), rain_at(Rain::kNone, outside_hz)) << outside_hz;
  }
  // Between its points it is linear: half a tenth of a decade above 1 kHz, halfway from 78.6 to 77.5 dB.
  EXPECT_NEAR(rain_at(Rain::kIntermediate, 1122.018), 78.05, 0.01);
}

TEST(Noise, TableIsLinearInTheLogarithmOfFrequencyAndConstantBeyondItsEnds) {
  const NoiseTable table{.frequency_hz = {10.0, 1000.0}, .level_db_re_1upa2_per_hz = {90.0, 60.0}};
  EXPECT_NEAR(spectral_density(table, Hertz{100.0}).value, 75.0, 1e-12);
  EXPECT_EQ(spectral_density(table, Hertz{1.0}).value, 90.0);
  EXPECT_EQ(spectral_density(table, Hertz{5000.0}).value, 60.0);
}

TEST(Noise, TableGivesItsOwnLevelsAtItsEnds) {
  const NoiseTable table{.frequency_hz = {10.0, 100.0, 1000.0}, .level_db_re_1upa2_per_hz = {90.0, 70.0, 60.0}};
  EXPECT_EQ(spectral_density(table, Hertz{10.0}).value, 90.0);
  EXPECT_EQ(spectral_density(table, Hertz{100.0}).value, 70.0);
  EXPECT_EQ(spectral_density(table, Hertz{1000.0}).value, 60.0);
  EXPECT_NEAR(spectral_density(table, Hertz{10.0 * std::pow(10.0, 0.25)}).value, 85.0, 1e-12);
  EXPECT_NEAR(spectral_density(table, Hertz{100.0 * std::pow(10.0, 0.75)}).value, 62.5, 1e-12);
}

TEST(Noise, TableOfOneRowIsThatLevelEverywhere) {
  const NoiseTable table{.frequency_hz = {100.0}, .level_db_re_1upa2_per_hz = {70.0}};
  for (const double frequency_hz : {1.0, 100.0, 100'000.0}) EXPECT_EQ(spectral_density(table, Hertz{frequency_hz}).value, 70.0);
}

TEST(Noise, LevelOfABandThatReachesBeyondTheTableCountsItsEndsOnwards) {
  const NoiseTable table{.frequency_hz = {50.0, 60.0}, .level_db_re_1upa2_per_hz = {80.0, 80.0}};
  const auto density = [&](Hertz f) { return spectral_density(table, f); };
  // 10 lg (1000 - 10) above 80 dB; the trapezoidal rule errs by (ln 100 / 1000)^2 / 12 of the whole.
  EXPECT_NEAR(band_level(density, {.low = Hertz{10.0}, .high = Hertz{1000.0}}).value, 80.0 + 29.95635, 2e-5);
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
