#include "firmware/detector/hydrophone/sound_detector.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "firmware/core/crc32.hpp"
#include "firmware/core/random.hpp"
#include "tests/firmware/detector/hydrophone/hearer.hpp"

namespace earshot::detector {
namespace {

constexpr double kRate = 1000.0;

/// Noise of 0.01 and pulses of 20 Hz for a second every 15 s, `snr_db` over the noise in the band.
std::vector<float> song(double seconds, double rate, double snr_db) {
  std::vector<float> samples = white_noise(seconds, rate, 0.01, 21);
  const double noise = 1e-4 * 15.0 / (rate / 2.0);
  for (double begin = 7.3; begin + 1.0 < seconds; begin += 15.0)
    add_tone(samples, rate, 20.0, std::sqrt(2.0 * noise * std::pow(10.0, snr_db / 10.0)), begin, 1.0);
  return samples;
}

double seconds_of(Time time) {
  return 1e-6 * static_cast<double>(time.us);
}

TEST(SoundDetector, FindsEveryPulseOfASongAndNothingElse) {
  Hearer hearer(fin_whale(), kRate);
  const std::vector<float> samples = song(600.0, kRate, 16.0);
  hearer.hear_twice(samples, kRate, fin_whale());
  ASSERT_EQ(hearer.detections.size(), 40U);
  for (std::size_t i = 0; i < 40; ++i) {
    const Detection& detection = hearer.detections[i];
    EXPECT_NEAR(seconds_of(detection.begin), 7.3 + 15.0 * static_cast<double>(i), 0.3) << "a quarter of a second, and the filter's rise";
    EXPECT_NEAR(detection.duration.to_seconds(), 1.0, 0.5);
    EXPECT_NEAR(detection.peak_snr.value, 16.0, 1.5);  // up to 0.6 dB less where no estimate has all of it; noise: 0.4 dB
    EXPECT_NEAR(seconds_of(detection.peak), seconds_of(detection.begin) + 1.0, 0.5);
    EXPECT_EQ(detection.worst, Hearing::kHears);
  }
}

TEST(SoundDetector, SaysTheSameBitsHoweverItsSoundComesInBlocks) {
  const std::vector<float> samples = song(80.0, kRate, 16.0);
  Hearer whole(fin_whale(), kRate);
  whole.hear(samples, 80'000);
  for (const std::size_t piece : {1U, 3U, 250U, 1024U, 4097U}) {
    Hearer hearer(fin_whale(), kRate);
    hearer.hear(samples, piece);
    ASSERT_EQ(hearer.estimates.size(), whole.estimates.size());
    for (std::size_t i = 0; i < whole.estimates.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(hearer.estimates[i].snr.value), std::bit_cast<std::uint64_t>(whole.estimates[i].snr.value))
          << piece;
      ASSERT_EQ(hearer.estimates[i].channels[0].level, whole.estimates[i].channels[0].level) << piece;
    }
  }
}

/// White noise that no libm has a hand in, nor a fused product: twice a number and less one is exact, and one rounding is left.
std::vector<float> sound_of_bits(std::size_t count) {
  Pcg32 random(99);
  std::vector<float> samples(count);
  for (float& x : samples) x = (2.0F * random.uniform_float() - 1.0F) * 0.01F;
  return samples;
}

TEST(SoundDetector, GivesTheSameBitsOnEveryMachine) {
  std::uint32_t checksum = 0;
  for (const double rate : {250.0, 2000.0, 48'000.0}) {
    Hearer hearer(fin_whale(), rate);
    hearer.hear(sound_of_bits(static_cast<std::size_t>(rate * 12.0)));
    for (const Estimate& estimate : hearer.estimates) {
      const auto bits = std::bit_cast<std::array<std::uint8_t, 8>>(estimate.channels[0].level.value);
      checksum ^= crc32(bits);
      checksum = std::rotl(checksum, 1);
    }
  }
  EXPECT_EQ(checksum, 0x7B418134U);  // of x86-64, GCC 12
}

TEST(SoundDetector, HearsEachChannelAsIfItWereAlone) {
  const std::vector<float> samples = song(60.0, kRate, 16.0);
  Hearer alone(fin_whale(), kRate);
  alone.hear(samples);
  Hearer array(fin_whale(), kRate, 3);
  std::vector<float> interleaved(3 * samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    interleaved[3 * i] = 0.5F * samples[i];
    interleaved[3 * i + 1] = samples[i];
    interleaved[3 * i + 2] = samples[samples.size() - 1 - i];
  }
  array.hear(interleaved);
  ASSERT_EQ(array.estimates.size(), alone.estimates.size());
  for (std::size_t i = 0; i < alone.estimates.size(); ++i) {
    EXPECT_EQ(array.estimates[i].channels[1].level, alone.estimates[i].channels[0].level);
    EXPECT_NEAR(array.estimates[i].channels[0].level.value, alone.estimates[i].channels[0].level.value - 6.0206, 1e-4);
  }
}

TEST(SoundDetector, HearsByTheChannelsThatHear) {
  Hearer array(fin_whale(), kRate, 2);
  const std::vector<float> samples = white_noise(60.0, kRate, 0.01, 2);
  std::vector<float> interleaved(2 * samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) interleaved[2 * i] = samples[i];  // the other is shorted
  array.hear(interleaved);
  const Estimate& last = array.estimates.back();
  EXPECT_EQ(last.hearing, Hearing::kHears);
  EXPECT_EQ(last.channels[1].hearing, Hearing::kStuck);
  EXPECT_EQ(last.level, last.channels[0].level);
}

TEST(SoundDetector, ListensToTheChannelsThatItIsToldTo) {
  SoundSettings settings = fin_whale();
  settings.channels = 0b10;
  Hearer array(settings, kRate, 2);
  std::vector<float> interleaved(2 * 60'000);
  const std::vector<float> samples = white_noise(60.0, kRate, 0.01, 2);
  for (std::size_t i = 0; i < samples.size(); ++i) interleaved[2 * i] = samples[i];
  array.hear(interleaved);
  EXPECT_EQ(array.estimates.back().hearing, Hearing::kStuck);
}

TEST(SoundDetector, HearsAToneThatNeverEndsByTheBandsBesideIt) {
  const SoundSettings settings = continuous_tone();
  const double noise = 1e-4 * 4.0 / (kRate / 2.0);
  std::vector<float> samples = white_noise(300.0, kRate, 0.01, 8);
  add_tone(samples, kRate, 20.3, std::sqrt(2.0 * noise * 100.0), 0.0, 300.0);  // 20 dB
  Hearer hearer(settings, kRate);
  hearer.hear(samples);
  hearer.finish();
  EXPECT_EQ(hearer.estimates.back().hearing, Hearing::kHears);
  EXPECT_NEAR(hearer.estimates.back().snr.value, 20.0, 1.0);  // floor: 0.3 dB; noise on the tone: 0.5 dB
  ASSERT_EQ(hearer.detections.size(), 1U);
  EXPECT_GT(hearer.detections[0].duration.to_seconds(), 150.0);
  Hearer past(fin_whale(), kRate);
  past.hear(samples);
  EXPECT_LT(past.estimates.back().level.value - past.estimates.back().floor.value, 1.0) << "what always sounds is noise to the others";
}

TEST(SoundDetector, IsNotLiftedByACallAsLongAsItIs) {
  std::vector<float> samples = white_noise(200.0, kRate, 0.01, 8);
  add_tone(samples, kRate, 20.3, 0.02, 140.0, 40.0);
  Hearer hearer(fin_whale(), kRate);
  hearer.hear(samples);
  double before_db = 0.0;
  for (const Estimate& estimate : hearer.estimates) {
    if (estimate.time < Time{138'000'000}) before_db = estimate.floor.value;
    if (estimate.time <= Time{141'000'000}) continue;
    EXPECT_NEAR(estimate.floor.value, before_db, 1.5);  // a third of calls: the noise's 0.77 quantile, 0.9 dB; chance
  }
  hearer.finish();
  ASSERT_EQ(hearer.detections.size(), 1U);
  EXPECT_NEAR(hearer.detections[0].duration.to_seconds(), 40.0, 1.0);
}

TEST(SoundDetector, ToldToAskForSeveralPassesOverAClick) {
  SoundSettings settings = fin_whale();
  std::vector<float> samples = white_noise(60.0, kRate, 0.01, 8);
  for (std::size_t i = 50'000; i < 50'004; ++i) samples[i] = 0.9F;
  Hearer one(settings, kRate);
  one.hear(samples);
  one.finish();
  EXPECT_EQ(one.detections.size(), 1U);
  settings.m_of_n = {.m = 6, .n = 8};  // a click lies in four or five estimates
  Hearer six(settings, kRate);
  six.hear(samples);
  six.finish();
  EXPECT_EQ(six.detections.size(), 0U);
}

TEST(SoundDetector, MeasuresForThePolicyWhatItHears) {
  Hearer hearer(fin_whale(), kRate);
  hearer.hear(song(60.0, kRate, 16.0));
  for (const Estimate& estimate : hearer.estimates) {
    if (!estimate.is_measured()) continue;
    const messages::SnrMeasurement taken = estimate.measurement();
    EXPECT_TRUE(messages::is_possible_snr(taken.snr));
    EXPECT_EQ(taken.time, estimate.time);
    EXPECT_EQ(taken.too_faint, estimate.too_faint);
  }
}

TEST(SoundDetector, HearsNothingUnlessItsSettingsAreRight) {
  SoundSettings settings = fin_whale();
  settings.band.high = Hertz{14};
  Hearer hearer(settings, kRate);
  EXPECT_EQ(hearer.status, Status::kOutOfRange);
  hearer.hear(white_noise(2.0, kRate, 0.01, 1));
  for (const Estimate& estimate : hearer.estimates) EXPECT_EQ(estimate.hearing, Hearing::kImpossible);
}

TEST(SoundDetector, BeginsAnewWithAnotherSampleRate) {
  Hearer hearer(fin_whale(), kRate);
  hearer.hear(white_noise(60.0, kRate, 0.01, 1));
  hearer.block.sample_rate = Hertz{500};
  hearer.hear(white_noise(60.0, 500, 0.01, 1));
  EXPECT_EQ(hearer.estimates.back().hearing, Hearing::kHears);
  EXPECT_NEAR(hearer.estimates.back().floor.value, 140.0 + 10.0 * std::log10(15.0 / 250.0), 1.0);
}

}  // namespace
}  // namespace earshot::detector
