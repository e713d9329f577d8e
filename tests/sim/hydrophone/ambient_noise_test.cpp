#include "sim/hydrophone/ambient_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/sim/hydrophone/spectrum.hpp"

namespace earshot::hydrophone {
namespace {

constexpr Hertz kRate{1000.0};
constexpr ocean::Band kFinWhale{.low = Hertz{15.0}, .high = Hertz{30.0}};

std::vector<double> noise(Decibels level, ocean::Band band, Pcg32 random, std::size_t count) {
  AmbientNoise sea(level, band, kRate, random);
  std::vector<double> samples(count);
  for (double& sample : samples) sample = sea.next();
  return samples;
}

// Simpson's rule on 200 000 intervals of the density, in Python; it agrees with the whole band's 1 to 2e-14.
TEST(AmbientNoise, HasTheShareOfItsPowerInABandThatIntegrationGives) {
  EXPECT_NEAR(share_in_band(kFinWhale, Hertz{20.0}, kRate), 0.21662919113095308, 1e-12);
  EXPECT_NEAR(share_in_band({.low = Hertz{18.0}, .high = Hertz{22.0}}, Hertz{20.0}, kRate), 0.06393540126941871, 1e-12);
  EXPECT_NEAR(share_in_band(kFinWhale, Hertz{20.0}, Hertz{48'000.0}), 0.21600065968717974, 1e-12);
  EXPECT_NEAR(share_in_band({.low = Hertz{0.0}, .high = Hertz{500.0}}, Hertz{20.0}, kRate), 1.0, 1e-12);
}

TEST(AmbientNoise, HasItsLevelInTheBand) {
  // 1000 s of 15 Hz are 30 000 degrees of freedom: 4.34 sqrt(2 / 30 000) = 0.035 dB; the bound is the level's of 0.1 dB.
  const std::vector<double> samples = noise(Decibels{90.0}, kFinWhale, Pcg32(1), 1'000'000);
  EXPECT_NEAR(10.0 * std::log10(power_in(kFinWhale, samples, kRate)), 90.0, 0.1);
}

TEST(AmbientNoise, FallsBySixDecibelsAnOctaveFarAboveItsCorner) {
  const std::vector<double> samples = noise(Decibels{90.0}, kFinWhale, Pcg32(2), 500'000);
  const auto density_db = [&](double f) {
    return 10.0 * std::log10(power_in({.low = Hertz{f - 2.0}, .high = Hertz{f + 2.0}}, samples, kRate));
  };
  // 10 lg of (1 + (f/20)^2) as an analog low-pass has it. Statistics: 4000 degrees of freedom, 0.1 dB each; sampling: 0.15 dB at 160 Hz.
  EXPECT_NEAR(density_db(5.0) - density_db(20.0), 2.75, 0.25);
  EXPECT_NEAR(density_db(40.0) - density_db(20.0), -3.98, 0.25);
  EXPECT_NEAR(density_db(80.0) - density_db(20.0), -9.29, 0.3);
  EXPECT_NEAR(density_db(160.0) - density_db(20.0), -15.12, 0.5);
}

TEST(AmbientNoise, IsAsLoudAtItsBeginningAsLater) {
  // The first sample of 4000 seas: 10 lg(1 / 0.2166) above the band's level; 4000 degrees of freedom give 0.1 dB.
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const double first = noise(Decibels{90.0}, kFinWhale, Pcg32(seed), 1).front();
    sum += first * first / 4000.0;
  }
  EXPECT_NEAR(10.0 * std::log10(sum), 96.64, 0.3);
}

}  // namespace
}  // namespace earshot::hydrophone
