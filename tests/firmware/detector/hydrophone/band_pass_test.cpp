#include "firmware/detector/hydrophone/band_pass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "tests/support/gaussian_noise.hpp"

namespace earshot::detector {
namespace {

// Oracle: scipy 1.10.1. The ripple's ends l and h lie (h - l) = (high - low) / 1.0744932 apart with l h = low high, and
//   sos = scipy.signal.cheby1(8, 0.05, [l, h], "bandpass", fs=rate, output="sos"); scipy.signal.sosfreqz(sos, f, fs=rate) + 0.025 dB

/// Of the filter as it runs, from its impulse response.
double gain_db(Band band, double rate, double frequency) {
  const BandPassDesign design = design_band_pass(band, Hertz{rate});
  std::vector<float> response(4000);
  response[0] = 1.0F;
  BandPass filter;
  filter.run(design, response);
  std::complex<double> sum;
  for (std::size_t i = 0; i < response.size(); ++i)
    sum += double{response[i]} * std::polar(1.0, -2.0 * M_PI * frequency * static_cast<double>(i) / rate);
  return 20.0 * std::log10(std::abs(sum));
}

constexpr Band kDefault{.low = Hertz{15}, .high = Hertz{30}};

TEST(BandPass, AnswersAsScipysFilterDoes) {
  const double tolerance = 2e-3;  // coefficients and sums in float; the skirts are steep
  for (const auto& [frequency, db] : {std::pair{14.0, -24.4219},
                                      {15.0, -2.9426},
                                      {16.0, 0.0002},
                                      {18.0, 0.0247},
                                      {21.21, -0.0091},
                                      {25.0, -0.0163},
                                      {29.0, 0.0014},
                                      {30.0, -5.748},
                                      {33.0, -42.7557}})
    EXPECT_NEAR(gain_db(kDefault, 120.0, frequency), db, tolerance) << frequency;
  EXPECT_NEAR(gain_db(kDefault, 120.0, 10.0), -78.395, 0.5);  // 1e-4 of the last place of what passes
  const Band at_50_hz{.low = Hertz{15}, .high = Hertz{22.5}};
  for (const auto& [frequency, db] : {std::pair{14.5, -13.6866}, {16.0, 0.0246}, {18.0, -0.025}, {22.0, -0.0071}})
    EXPECT_NEAR(gain_db(at_50_hz, 50.0, frequency), db, tolerance) << frequency;
  const Band narrow{.low = Hertz{14}, .high = Hertz{17}};
  for (const auto& [frequency, db] : {std::pair{14.0, -3.5423}, {15.0, -0.0117}, {16.0, -0.0245}, {18.0, -54.3329}})
    EXPECT_NEAR(gain_db(narrow, 122.5, frequency), db, 10 * tolerance) << frequency;
}

TEST(BandPass, PassesAsMuchNoiseAsUprightWallsWould) {
  EXPECT_NEAR(measure(design_band_pass(kDefault, Hertz{120}), Hertz{120}, 120).noise_width_hz, 14.897335, 1e-3);  // scipy, as above
  EXPECT_NEAR(measure(design_band_pass({Hertz{14}, Hertz{17}}, Hertz{122.5}), Hertz{122.5}, 124).noise_width_hz, 2.999178, 1e-3);
}

TEST(BandPass, DelaysAsScipysImpulseResponseSays) {
  EXPECT_NEAR(measure(design_band_pass(kDefault, Hertz{120}), Hertz{120}, 120).delay, 22.6817, 1e-2);
}

TEST(BandPass, HasTheDegreesOfFreedomOfScipysImpulseResponse) {
  EXPECT_NEAR(measure(design_band_pass(kDefault, Hertz{120}), Hertz{120}, 120).degrees_of_freedom, 31.3218, 1e-2);
  EXPECT_NEAR(measure(design_band_pass({Hertz{15}, Hertz{22.5}}, Hertz{50}), Hertz{50}, 52).degrees_of_freedom, 16.666, 1e-2);
}

TEST(BandPass, GivesNoiseAsManyDegreesOfFreedomAsWereCounted) {
  const BandPassDesign design = design_band_pass(kDefault, Hertz{120});
  support::GaussianNoise noise(4);
  BandPass filter;
  std::vector<float> samples(120 * 20'000);
  for (float& x : samples) x = noise();
  filter.run(design, samples);
  double sum = 0.0;
  double squares = 0.0;
  int windows = 0;
  for (std::size_t begin = 120; begin + 120 <= samples.size(); begin += 240, ++windows) {
    double power = 0.0;
    for (std::size_t i = begin; i < begin + 120; ++i) power += double{samples[i]} * double{samples[i]} / 120.0;
    sum += power;
    squares += power * power;
  }
  const double mean = sum / windows;
  const double variance = squares / windows - mean * mean;
  EXPECT_NEAR(2.0 * mean * mean / variance, 31.32, 1.5);  // of 10 000 powers: 1.5 % of the variance's estimate, three times
  EXPECT_NEAR(mean, 14.897 / 60.0, 0.0025);               // 0.26 % of the mean, four times
}

}  // namespace
}  // namespace earshot::detector
