#include "hil/nodes/sound/hydrophone_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace earshot::hil {
namespace {

/// So many blocks, 0.25 s each, one behind the other; those that are not sent are left out.
std::vector<float> sound(HydrophoneSamples& hydrophone, int blocks) {
  std::vector<float> all;
  for (int i = 1; i <= blocks; ++i) {
    if (hydrophone.take(Time{i * 250'000})) all.insert(all.end(), hydrophone.samples().begin(), hydrophone.samples().end());
  }
  return all;
}

/// Mean square of what lies within a bin's width of one frequency: |X|^2 2 / N^2 of a real signal.
double power_at(const std::vector<float>& x, double hz) {
  std::complex<double> sum;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += static_cast<double>(x[i]) * std::polar(1.0, -2.0 * std::numbers::pi * hz * static_cast<double>(i) / 500.0);
  const auto n = static_cast<double>(x.size());
  return 2.0 * std::norm(sum) / (n * n);
}

double mean_square(const std::vector<float>& x) {
  double sum = 0.0;
  for (const float value : x) sum += static_cast<double>(value) * static_cast<double>(value);
  return sum / static_cast<double>(x.size());
}

// -90 dB of noise in 4 of 250 Hz: 62.5e-9 in all. A tone 10 dB over the noise in the band: 1e-8.
TEST(HydrophoneSamples, HasTheSourceAndTheNoiseAtTheLevelsThatItsSnrSays) {
  HydrophoneSamples hydrophone(Decibels{10.0}, 1);
  const std::vector<float> x = sound(hydrophone, 400);
  EXPECT_NEAR(power_at(x, 20.0), 1e-8, 0.03e-8);      // the noise in a bin of 0.01 Hz is 2.5e-12: 1.6 % of the amplitude
  EXPECT_NEAR(mean_square(x), 62.5e-9 + 1e-8, 2e-9);  // 50 000 samples: 0.6 % of the noise's power, three times
}

TEST(HydrophoneSamples, ClipsWhatIsBeyondFullScaleAndCountsIt) {
  HydrophoneSamples hydrophone(Decibels{20.0}, 1);
  hydrophone.disturb({.line = SoundLine::kWhole, .gain_error = Decibels{100.0}});
  const std::vector<float> x = sound(hydrophone, 1);
  const auto clipped = std::ranges::count_if(x, [](float value) { return value == -1.0F || value == static_cast<float>(1.0 - 0x1p-23); });
  EXPECT_GT(clipped, 60);
  EXPECT_EQ(hydrophone.block().overflow_count, static_cast<std::uint32_t>(clipped));
}

TEST(HydrophoneSamples, HasAllTwentyDecibelsLowerWhereTheGainIs) {
  HydrophoneSamples right(Decibels{10.0}, 1);
  HydrophoneSamples low(Decibels{10.0}, 1);
  low.disturb({.line = SoundLine::kWhole, .gain_error = Decibels{-20.0}});
  EXPECT_NEAR(mean_square(sound(right, 4)) / mean_square(sound(low, 4)), 100.0, 0.5);  // the ADC's steps
  EXPECT_EQ(low.block().gain, Decibels{}) << "it says nothing of it";
}

TEST(HydrophoneSamples, HearsTheMainsAloneOnAnOpenLineAndNothingOnAShortedOne) {
  HydrophoneSamples hydrophone(Decibels{10.0}, 1);
  hydrophone.disturb({.line = SoundLine::kOpen});
  const std::vector<float> hum = sound(hydrophone, 4);
  EXPECT_NEAR(power_at(hum, 50.0), 0.5e-4, 0.5e-9);
  EXPECT_LT(power_at(hum, 20.0), 1e-15);
  hydrophone.disturb({.line = SoundLine::kShorted});
  EXPECT_EQ(mean_square(sound(hydrophone, 1)), 0.0);
}

TEST(HydrophoneSamples, CountsWhatItTakesWhileItIsMuteAndNotItsBlocks) {
  HydrophoneSamples hydrophone(Decibels{10.0}, 1);
  (void)sound(hydrophone, 2);
  hydrophone.disturb({.is_mute = true});
  EXPECT_TRUE(sound(hydrophone, 3).empty());
  hydrophone.disturb({});
  ASSERT_TRUE(hydrophone.take(Time{1'500'000}));
  EXPECT_EQ(hydrophone.block().first_sample, 5 * 125);
  EXPECT_EQ(hydrophone.block().sequence, 2);
  EXPECT_EQ(hydrophone.block().time, Time{1'250'000});
}

}  // namespace
}  // namespace earshot::hil
