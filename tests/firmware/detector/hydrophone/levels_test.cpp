// Whether levels and SNRs are what they should be. Full scale of the default calibration is 180 dB re 1 uPa (peak): a tone of amplitude a
// has 180 - 3.0103 + 20 lg a, white noise of deviation s at a sample rate has 180 + 20 lg s + 10 lg(15 / (rate / 2)) in the band of 15 Hz.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/detector/hydrophone/hearer.hpp"

namespace earshot::detector {
namespace {

/// Mean level of the independent estimates that are not of the beginning, in power.
double mean_level_db(const Hearer& hearer) {
  double sum = 0.0;
  int count = 0;
  for (const Estimate& estimate : hearer.estimates) {
    if (!estimate.is_independent) continue;
    sum += std::pow(10.0, estimate.channels[0].level.value / 10.0);
    ++count;
  }
  return 10.0 * std::log10(sum / count);
}

TEST(SoundLevel, OfATonesIsRightWithinATenthOfADecibelAtEverySampleRate) {
  for (const double rate : {250.0, 441.0, 1000.0, 2000.0, 8000.0, 44'100.0, 48'000.0, 96'000.0}) {
    for (const double frequency : {16.0, 18.3, 20.0, 23.7, 27.1, 29.0}) {
      Hearer hearer(fin_whale(), rate);
      std::vector<float> samples(static_cast<std::size_t>(6.0 * rate));
      add_tone(samples, rate, frequency, 0.01, 0.0, 6.0);
      hearer.hear(samples);
      EXPECT_NEAR(mean_level_db(hearer), 180.0 - 3.0103 - 40.0, 0.1) << frequency << " Hz at " << rate;  // the bar
    }
  }
}

TEST(SoundLevel, OfTenMinutesOfNoiseIsRightWithinThreeTenthsOfADecibel) {
  for (const double rate : {250.0, 1000.0, 2500.0}) {
    Hearer hearer(fin_whale(), rate);
    hearer.hear(white_noise(600.0, rate, 0.01, 7));
    const double expected = 180.0 - 40.0 + 10.0 * std::log10(15.0 / (rate / 2.0));
    EXPECT_NEAR(mean_level_db(hearer), expected, 0.15) << rate;  // twice as good as the bar; 600 powers of 31 degrees: 0.05 dB of chance
    EXPECT_NEAR(hearer.estimates.back().floor.value, expected, 0.7) << "120 of them, their median: 0.13 dB of chance, and it wanders";
  }
}

TEST(SoundLevel, CountsGainAndSensitivity) {
  SoundSettings settings = fin_whale();
  settings.calibration = {.sensitivity = Decibels{-165}, .fixed_gain = Decibels{20}, .full_scale_volts = 2.0};
  Hearer hearer(settings, 1000);
  hearer.block.gain = Decibels{6};
  std::vector<float> samples(6000);
  add_tone(samples, 1000, 20.0, 0.1, 0.0, 6.0);
  hearer.hear(samples);
  EXPECT_NEAR(mean_level_db(hearer), 6.0206 + 165.0 - 26.0 - 20.0 - 3.0103, 0.1);  // by hand
}

/// SNR of a tone in noise, by the sonar equation: level of the tone less level of the noise.
TEST(SoundSnr, IsTheSignalsOwnLevelLessTheNoises) {
  constexpr double kRate = 500.0;
  const double noise_db = 10.0 * std::log10(1e-4 * 15.0 / (kRate / 2.0));
  for (const double snr_db : {3.0, 10.0, 20.0}) {
    Hearer hearer(fin_whale(), kRate);
    std::vector<float> samples = white_noise(140.0 + 1200.0, kRate, 0.01, 11);
    for (int pulse = 0; pulse < 40; ++pulse)  // a twelfth of the time
      add_tone(samples, kRate, 20.0, std::sqrt(2.0 * std::pow(10.0, (noise_db + snr_db) / 10.0)), 140.0 + 30.0 * pulse, 2.5);
    hearer.hear(samples);
    double signal = 0.0;
    int count = 0;
    for (const Estimate& estimate : hearer.estimates) {
      const double since = std::fmod(1e-6 * static_cast<double>(estimate.time.us) - 140.0, 30.0);
      if (estimate.time.us < 140'000'000 || since < 1.4 || since > 2.4) continue;  // all of its second lies within the pulse
      signal += estimate.too_faint ? 0.0 : std::pow(10.0, estimate.snr.value / 10.0);
      ++count;
    }
    ASSERT_GE(count, 120);
    EXPECT_NEAR(10.0 * std::log10(signal / count), snr_db, 0.5) << snr_db;  // the pulses lift the floor by 0.3 dB; chance
  }
}

TEST(SoundSnr, OfNoiseAloneIsTooFaintButOnceInAThousand) {
  Hearer hearer(fin_whale(), 250);
  hearer.hear(white_noise(20'000.0, 250, 0.01, 13));
  int heard = 0;
  int measured = 0;
  for (const Estimate& estimate : hearer.estimates) {
    if (!estimate.is_snr_measurement()) continue;
    ++heard;
    if (estimate.too_faint) {
      EXPECT_NEAR(estimate.snr.value, -0.05, 0.1);  // chi-square's 0.999 quantile less one, 31 degrees: by scipy 0.969
    } else {
      ++measured;
    }
  }
  EXPECT_GT(heard, 19'900);
  EXPECT_LT(measured, 50);  // 20 with the noise known; the estimated floor's own spread makes about 30
  EXPECT_GT(measured, 5);
}

}  // namespace
}  // namespace earshot::detector
