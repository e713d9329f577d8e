// What the detector says where it cannot hear.
#include <gtest/gtest.h>

#include <limits>
#include <string_view>

#include "tests/firmware/detector/hydrophone/hearer.hpp"
#include "tests/firmware/not_finite.hpp"

namespace earshot::detector {
namespace {

constexpr double kRate = 1000.0;
using tests::kNan;

/// A detector that knows its noise.
Hearer settled(const SoundSettings& settings = fin_whale()) {
  Hearer hearer(settings, kRate);
  hearer.hear(white_noise(60.0, kRate, 0.01, 3));
  EXPECT_EQ(hearer.estimates.back().hearing, Hearing::kHears);
  hearer.estimates.clear();
  return hearer;
}

/// What it said first of `samples`, and that it hears again within a few seconds of noise.
Hearing worst_of(Hearer& hearer, std::vector<float> samples) {
  hearer.hear(samples);
  Hearing worst = Hearing::kHears;
  for (const Estimate& estimate : hearer.estimates) worst = std::max(worst, estimate.hearing);
  hearer.hear(white_noise(8.0, kRate, 0.01, 5));
  EXPECT_EQ(hearer.estimates.back().hearing, Hearing::kHears) << "hears again";
  return worst;
}

TEST(Hearing, DoesNotKnowTheNoiseAtFirst) {
  Hearer hearer(fin_whale(), kRate);
  hearer.hear(white_noise(60.0, kRate, 0.01, 3));
  ASSERT_FALSE(hearer.estimates.empty());
  EXPECT_EQ(hearer.estimates[0].hearing, Hearing::kFillingUp);
  EXPECT_EQ(hearer.estimates[40].hearing, Hearing::kFloorUnsettled);
  EXPECT_TRUE(std::isnan(hearer.estimates[40].snr.value));
  int told = 0;
  for (const Estimate& estimate : hearer.estimates) told += estimate.is_measured() ? 1 : 0;
  EXPECT_NEAR(told / 4.0, 60.0 - 30.0 - 4.0, 2.0) << "a quarter of two minutes, and the filters and what is learnt late";
}

TEST(Hearing, SaysThatSamplesAreAtFullScale) {
  Hearer hearer = settled();
  std::vector<float> samples = white_noise(2.0, kRate, 0.01, 4);
  samples[1000] = 1.0F;
  EXPECT_EQ(worst_of(hearer, samples), Hearing::kClipped);
  Hearer other = settled();
  samples[1000] = -1.0F;
  EXPECT_EQ(worst_of(other, samples), Hearing::kClipped);
}

TEST(Hearing, HasJustBegunEvenWhereTheBeginningIsClipped) {
  Hearer hearer = settled();
  hearer.detector->begin_again_knowing_the_noise();
  hearer.block.first_sample = 0;
  std::vector<float> samples = white_noise(20.0, kRate, 0.01, 4);
  for (std::size_t i = 0; i < 50; ++i) samples[i] = 1.0F;  // switched on
  hearer.hear(samples);
  hearer.finish();
  EXPECT_EQ(hearer.estimates.front().hearing, Hearing::kFillingUp);
  EXPECT_TRUE(hearer.detections.empty());
}

TEST(Hearing, SaysThatTheAdcIsSaturated) {
  Hearer hearer = settled();
  std::vector<float> samples = white_noise(3.0, kRate, 0.01, 4);
  for (std::size_t i = 1000; i < 2000; ++i) samples[i] = i % 3 == 0 ? 0.9F : 1.0F;
  EXPECT_EQ(worst_of(hearer, samples), Hearing::kSaturated);
}

TEST(Hearing, SaysThatEverySampleIsAlike) {
  for (const float stuck : {0.0F, 0.25F}) {
    Hearer hearer = settled();
    EXPECT_EQ(worst_of(hearer, std::vector<float>(2000, stuck)), Hearing::kStuck) << stuck;
  }
}

TEST(Hearing, SaysThatSamplesAreNoNumbersAndHearsOn) {
  for (const float bad :
       {static_cast<float>(kNan), std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(), 10.0F, -1e10F, 3e38F}) {
    Hearer hearer = settled();
    std::vector<float> samples = white_noise(2.0, kRate, 0.01, 4);
    samples[500] = bad;
    EXPECT_EQ(worst_of(hearer, samples), Hearing::kNotANumber) << bad;
    for (const Estimate& estimate : hearer.estimates)
      EXPECT_NEAR(estimate.channels[0].level.value, hearer.estimates.front().channels[0].level.value, 12.0) << bad;
  }
}

TEST(Hearing, HearsNothingInNothingButNans) {
  Hearer hearer(fin_whale(), kRate);
  hearer.hear(std::vector<float>(20'000, kNan));
  for (const Estimate& estimate : hearer.estimates) EXPECT_EQ(estimate.hearing, Hearing::kNotANumber);
}

TEST(Hearing, SaysThatTheHydrophoneIsOpen) {
  SoundSettings settings = fin_whale();
  settings.calibration.adc_bits = 16;
  Hearer hearer(settings, kRate);
  std::vector<float> samples = white_noise(60.0, kRate, 0.3 / 32'768.0, 3);  // less than a step: the ADC's own noise
  for (float& x : samples) x = std::round(x * 32'768.0F) / 32'768.0F;
  hearer.hear(samples);
  EXPECT_EQ(hearer.estimates.back().hearing, Hearing::kOpen);
  Hearer connected(settings, kRate);
  connected.hear(white_noise(60.0, kRate, 3.0 / 32'768.0, 3));
  EXPECT_EQ(connected.estimates.back().hearing, Hearing::kHears);
}

TEST(Hearing, SaysThatSamplesAreMissingAndKeepsWhatItKnowsOfTheNoise) {
  Hearer hearer = settled();
  const double floor_db = hearer.detector->plan() != nullptr ? 0.0 : 1.0;
  EXPECT_EQ(floor_db, 0.0);
  hearer.block.first_sample += 17;
  EXPECT_EQ(worst_of(hearer, white_noise(1.0, kRate, 0.01, 4)), Hearing::kDropout);
}

/// What ended with the gap is not held against what comes after it: what was heard in the last second, say, ten times.
TEST(Hearing, LearnsNoNoiseFromWhatEndedWithTheGap) {
  std::vector<std::vector<Estimate>> estimates;
  for (const float deviation : {0.01F, 0.2F}) {
    Hearer hearer(fin_whale(), kRate);
    hearer.hear(white_noise(0.001, kRate, 0.01, 3));  // so that there is a plan
    const std::size_t quarter = hearer.detector->plan()->quarter * hearer.detector->plan()->factor();
    const std::vector<float> noise = white_noise(62.0, kRate, 0.01, 3);
    hearer.hear(std::span(noise).first(quarter - 1));
    const std::vector<float> last = white_noise(2.0, kRate, double{deviation}, 5);
    for (int gap = 0; gap < 10; ++gap) {
      for (std::size_t at = quarter; at < 200 * quarter || !hearer.estimates.back().is_independent; at += quarter)
        hearer.hear(std::span(noise).subspan(at, quarter));
      hearer.hear(std::span(last).first(4 * quarter));
      ASSERT_TRUE(hearer.estimates.back().is_independent) << "its noise waits to be learnt";
      hearer.block.first_sample += 17;
    }
    hearer.estimates.clear();
    hearer.hear(white_noise(20.0, kRate, 0.01, 4));
    estimates.push_back(hearer.estimates);
  }
  ASSERT_EQ(estimates[0].size(), estimates[1].size());
  ASSERT_EQ(estimates[0].back().hearing, Hearing::kHears);
  for (std::size_t i = 0; i < estimates[0].size(); ++i)
    EXPECT_EQ(estimates[0][i].channels[0].floor, estimates[1][i].channels[0].floor) << "estimate " << i;
}

TEST(Hearing, SaysThatTheGainChangedAndCountsIt) {
  Hearer hearer = settled();
  hearer.block.gain = Decibels{20};
  std::vector<float> samples = white_noise(9.0, kRate, 0.1, 4);  // the same pressure
  hearer.hear(samples);
  EXPECT_EQ(hearer.estimates.front().hearing, Hearing::kGainChanged);
  EXPECT_EQ(hearer.estimates.back().hearing, Hearing::kHears);
  for (const Estimate& estimate : hearer.estimates) EXPECT_FALSE(estimate.reaches_threshold);
}

TEST(Hearing, SaysThatTheVehicleHearsItself) {
  SoundSettings settings = fin_whale();
  settings.gate = {.speed = MetersPerSecond{1.5}, .thruster_rpm = 300.0};
  for (const auto& [speed, rpm] : {std::pair{2.0, 0.0}, {1.0, 301.0}}) {
    Hearer hearer = settled(settings);
    hearer.detector->note_motion(MetersPerSecond{speed}, rpm);
    hearer.hear(white_noise(2.0, kRate, 0.01, 4));
    EXPECT_EQ(hearer.estimates.back().hearing, Hearing::kSelfNoise);
    hearer.detector->note_motion(MetersPerSecond{1.0}, 299.0);
    hearer.hear(white_noise(2.0, kRate, 0.01, 4));
    EXPECT_EQ(hearer.estimates.back().hearing, Hearing::kHears);
  }
}

/// Noise whose power falls by 12 dB an octave.
std::vector<float> flow_noise(double seconds, double deviation) {
  std::vector<float> samples = white_noise(seconds, kRate, deviation, 9);
  float once = 0.0F;
  float twice = 0.0F;
  for (float& x : samples) {
    once = 0.99F * once + x;
    twice = 0.99F * twice + 0.01F * once;
    x = twice;
  }
  return samples;
}

TEST(Hearing, SaysThatFlowNoiseDrownsTheAmbient) {
  SoundSettings settings = fin_whale();
  settings.expected_noise = Decibels{90};
  Hearer flow(settings, kRate);
  flow.hear(flow_noise(60.0, 0.01));
  EXPECT_EQ(flow.estimates.back().hearing, Hearing::kFlowNoise);
  EXPECT_GT(flow.estimates.back().channels[0].floor.value, 110.0);
  Hearer ship(settings, kRate);
  ship.hear(white_noise(60.0, kRate, 0.01, 9));  // 125 dB, as far above the ambient, but even
  EXPECT_EQ(ship.estimates.back().hearing, Hearing::kHears);
  settings.expected_noise = Decibels{std::numeric_limits<double>::quiet_NaN()};
  Hearer unknown(settings, kRate);
  unknown.hear(flow_noise(60.0, 0.01));
  EXPECT_EQ(unknown.estimates.back().hearing, Hearing::kHears) << "nothing is known of the ambient";
}

TEST(Hearing, RefusesABlockThatCannotBe) {
  const std::vector<float> samples(100);
  const auto said_of = [&](auto change) {
    Hearer hearer(fin_whale(), kRate);
    hearer.block.samples_per_channel = 100;
    change(hearer.block);
    hearer.hear_block(samples);
    return hearer.estimates.size() == 1 ? hearer.estimates[0].hearing : Hearing::kHears;
  };
  using Block = messages::HydrophoneBlock;
  EXPECT_EQ(said_of([](Block& b) { b.sample_rate = Hertz{65.0}; }), Hearing::kImpossible) << "below 2.2 times 30 Hz";
  EXPECT_EQ(said_of([](Block& b) { b.sample_rate = Hertz{96'001.0}; }), Hearing::kImpossible);
  EXPECT_EQ(said_of([](Block& b) { b.sample_rate = Hertz{std::numeric_limits<double>::quiet_NaN()}; }), Hearing::kImpossible);
  EXPECT_EQ(said_of([](Block& b) { b.channels = 0; }), Hearing::kImpossible);
  EXPECT_EQ(said_of([](Block& b) { b.channels = 9; }), Hearing::kImpossible);
  EXPECT_EQ(said_of([](Block& b) { b.samples_per_channel = 99; }), Hearing::kImpossible);
  EXPECT_EQ(said_of([](Block& b) { b.gain = Decibels{std::numeric_limits<double>::infinity()}; }), Hearing::kImpossible);
  EXPECT_EQ(said_of([](Block& b) { b.first_sample = -1; }), Hearing::kImpossible);
  EXPECT_EQ(said_of([](Block& b) { b.time.us = std::numeric_limits<std::int64_t>::max(); }), Hearing::kImpossible);
}

TEST(Hearing, SaysWhatIsWrongWithTheChain) {
  SoundSettings settings = fin_whale();
  settings.expected_noise = Decibels{60};
  settings.calibration.adc_bits = 8;
  Hearer hearer(settings, kRate);
  ASSERT_EQ(hearer.status, Status::kOk) << "what the ADC's noise is, only the sample rate tells";
  hearer.hear(white_noise(1.0, kRate, 0.01, 1));
  EXPECT_EQ(hearer.estimates.at(0).hearing, Hearing::kImpossible);
  EXPECT_EQ(hearer.detector->calibration_fault(), CalibrationFault::kNoise);
}

TEST(Hearing, SaysEveryThingInTheWayInWordsOfItsOwn) {
  for (std::size_t a = 0; a < kHearings; ++a) {
    for (std::size_t b = 0; b < a; ++b) EXPECT_NE(std::string_view(to_string(static_cast<Hearing>(a))), to_string(static_cast<Hearing>(b)));
    EXPECT_NE(std::string_view(to_string(static_cast<Hearing>(a))), "?");
  }
}

}  // namespace
}  // namespace earshot::detector
