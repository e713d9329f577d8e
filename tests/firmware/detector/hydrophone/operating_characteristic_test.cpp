// A short form of the operating characteristic; tests/acoustics/run takes four million decisions to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/firmware/detector/hydrophone/hearer.hpp"
#include "tests/firmware/emulated.hpp"

namespace earshot::detector {
namespace {

constexpr double kRate = 240.0;                          // low rate 120 Hz: an integration time of exactly 1 s
constexpr int kDecisions = tests::times(20'000, 5'000);  // the same sound, and as far from the theory, in every emulator

/// P / N in dB of estimates that share no sound: of noise, and of the same noise with a tone of 1 dB.
struct Ratios {
  std::vector<double> noise;
  std::vector<double> tone;
};

/// @param is_known  N is what was made; otherwise what the noise's own floor says
Ratios heard(bool is_known) {
  const double noise_db = 140.0 + 10.0 * std::log10(15.0 / (kRate / 2.0));
  Hearer hearer(fin_whale(), kRate, 2);
  const std::vector<float> noise = white_noise(kDecisions + 150.0, kRate, 0.01, 31);
  std::vector<float> tone = noise;
  add_tone(tone, kRate, 20.3, std::sqrt(2.0 * std::pow(10.0, (noise_db - 180.0 + 1.0) / 10.0)), 0.0, 1e9);
  std::vector<float> samples;
  for (std::size_t i = 0; i < noise.size(); ++i) samples.insert(samples.end(), {noise[i], tone[i]});
  hearer.hear(samples, 24'000);
  Ratios ratios;
  for (const Estimate& estimate : hearer.estimates) {
    if (!estimate.is_independent || estimate.time < Time{130'000'000}) continue;
    const double floor_db = is_known ? noise_db : estimate.channels[0].floor.value;
    ratios.noise.push_back(estimate.channels[0].level.value - floor_db);
    ratios.tone.push_back(estimate.channels[1].level.value - floor_db);
  }
  return ratios;
}

struct Point {
  double threshold_db = 0.0;  ///< P / N with one false alarm in a thousand
  double detections = 0.0;    ///< share of estimates with the tone that reach it
};

Point point_of(Ratios ratios) {
  std::ranges::sort(ratios.noise, std::greater<>());
  const double threshold_db = ratios.noise[ratios.noise.size() / 1000];
  const auto found = std::ranges::count_if(ratios.tone, [&](double ratio) { return ratio >= threshold_db; });
  return {.threshold_db = threshold_db, .detections = static_cast<double>(found) / static_cast<double>(ratios.tone.size())};
}

// Theory: tests/acoustics/operating_characteristic.py (scipy 1.10.1), 30 degrees of freedom, P_fa 1e-3, SNR 1 dB. P_d changes by 0.2 in
// a decibel of SNR there.

TEST(OperatingCharacteristic, IsTheEnergyDetectorsWhereTheNoiseIsKnown) {
  const Point point = point_of(heard(true));
  EXPECT_NEAR(point.threshold_db, 2.9888, 0.15);  // the bar; chance: 0.05 dB, 0.1 where a quarter is heard
  EXPECT_NEAR(point.detections, 0.6955, 0.15 * 0.2 + 0.02);
}

TEST(OperatingCharacteristic, IsThatOfAConstantFalseAlarmRateWhereTheNoiseIsEstimated) {
  const Point point = point_of(heard(false));
  EXPECT_NEAR(point.threshold_db, 3.0180, 0.3);
  EXPECT_NEAR(point.detections, 0.6835, 0.3 * 0.2 + 0.02);
}

}  // namespace
}  // namespace earshot::detector
