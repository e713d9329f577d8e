#include "firmware/boards/linux/hydrophone/hydrophone_processor.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "firmware/boards/linux/hydrophone/hearing_words.hpp"
#include "firmware/core/random.hpp"
#include "firmware/wire/lcm/hydrophone_block.hpp"
#include "tests/support/gaussian_noise.hpp"
#include "tests/support/hydrophone_driver.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

using detector::Hearing;

constexpr double kRate_hz = 1000.0;
constexpr std::uint32_t kBlock = 100;  ///< samples: a tenth of a second
constexpr std::int64_t kBegan_us = 1'795'000'000'000'000;
constexpr double kFullScale_db = 180.0;  ///< a sensitivity of -180 dB re 1 V/uPa, no gain, 1 V
constexpr double kNoise_db = 90.0;       ///< in the band

detector::SoundSettings fin_whale_settings() {
  detector::SoundSettings settings = detector::fin_whale();
  settings.calibration = {
      .sensitivity = Decibels{-180}, .fixed_gain = Decibels{0}, .full_scale_volts = 1.0, .adc_bits = 24, .high_pass_corner = {}};
  return settings;
}

/// White noise of kNoise_db in the 15 Hz of the band, and a tone while there is one.
class Sea {
 public:
  explicit Sea(HydrophoneProcessor& processor) : processor_(processor) {
    block_.time = {kBegan_us};
    block_.sample_rate = Hertz{kRate_hz};
    block_.samples_per_channel = kBlock;
    block_.channels = 1;
    sigma_ = std::pow(10.0, (kNoise_db - kFullScale_db) / 20.0) / std::sqrt(15.0 / (kRate_hz / 2.0));
  }
  messages::HydrophoneBlock& block() { return block_; }
  [[nodiscard]] double now_s() const { return static_cast<double>(block_.first_sample) / kRate_hz; }

  /// A tone of 20 Hz so much over the noise, from `begin_s` of all time to `end_s`.
  void call(double snr_db, double begin_s, double end_s) {
    amplitude_ = std::sqrt(2.0) * std::pow(10.0, (kNoise_db + snr_db - kFullScale_db) / 20.0);
    begin_s_ = begin_s;
    end_s_ = end_s;
  }
  void hear_until(double end_s) {
    while (now_s() < end_s - 1e-9) hear();
  }
  void hear() {
    std::vector<float> samples(kBlock);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double t = (static_cast<double>(block_.first_sample) + static_cast<double>(i)) / kRate_hz;
      const double tone = t >= begin_s_ && t < end_s_ ? amplitude_ * std::sin(2.0 * std::numbers::pi * 20.0 * t) : 0.0;
      samples[i] = static_cast<float>(sigma_ * double{noise_()} + tone) + offset;
    }
    processor_.hear(block_, samples);
    skip(kBlock);
    ++block_.sequence;
  }
  /// The ADC goes on unheard.
  void skip(std::int64_t samples) {
    block_.first_sample += samples;
    block_.time = {kBegan_us + block_.first_sample * 1'000'000 / static_cast<std::int64_t>(kRate_hz)};
  }
  float offset = 0.0F;

 private:
  HydrophoneProcessor& processor_;
  messages::HydrophoneBlock block_;
  support::GaussianNoise noise_{7};
  double sigma_ = 0.0;
  double amplitude_ = 0.0;
  double begin_s_ = 0.0;
  double end_s_ = 0.0;
};

std::vector<messages::SnrMeasurement> measurements_of(HydrophoneProcessor& processor) {
  std::vector<messages::SnrMeasurement> measurements;
  for (messages::SnrMeasurement measurement; processor.take(measurement);) measurements.push_back(measurement);
  return measurements;
}

double seconds_since_beginning(Time time) {
  return 1e-6 * static_cast<double>(time.us - kBegan_us);
}

double seconds(const HydrophoneProcessor& processor, Hearing hearing) {
  return processor.heard().sound.at(static_cast<std::size_t>(hearing)).to_seconds();
}

bool is_set(const HydrophoneProcessor& processor) {
  pollfd event{.fd = processor.file_descriptor(), .events = POLLIN, .revents = 0};
  return ::poll(&event, 1, 0) == 1;
}

/// When the measurements end that a sea of noise gives: they do not depend on what is heard.
double end_of_a_measurement_after(double time_s) {
  HydrophoneProcessor processor(fin_whale_settings(), WakesFor::kMeasurements);
  Sea(processor).hear_until(time_s + 3.0);
  for (const messages::SnrMeasurement& measurement : measurements_of(processor)) {
    if (const double end_s = seconds_since_beginning(measurement.time); end_s > time_s) return end_s;
  }
  return 0.0;
}

TEST(HydrophoneProcessor, GivesOneMeasurementASecondWithTheSnrOfATone) {
  HydrophoneProcessor processor(fin_whale_settings(), WakesFor::kMeasurements);
  Sea sea(processor);
  const double begin_s = end_of_a_measurement_after(90.0);
  sea.call(12.0, begin_s, begin_s + 10.0);
  sea.hear_until(102.0);
  double sum_db = 0.0;
  int in_tone = 0;
  std::int64_t last_us = 0;
  for (const messages::SnrMeasurement& measurement : measurements_of(processor)) {
    const double between_us = last_us == 0 ? 992'000.0 : static_cast<double>(measurement.time.us - last_us);
    EXPECT_NEAR(between_us, 992'000.0, 2.0) << "no sound counts twice, none is left out: four quarters of 31 samples at 125 Hz";
    last_us = measurement.time.us;
    const double end_s = seconds_since_beginning(measurement.time);
    if (end_s < begin_s + 0.9 || end_s > begin_s + 10.1) continue;
    EXPECT_FALSE(measurement.too_faint);
    sum_db += measurement.snr.value;
    ++in_tone;
  }
  ASSERT_EQ(in_tone, 10);
  EXPECT_NEAR(sum_db / in_tone, 12.0, 0.5) << "ten looks scatter by 0.12 dB, the floor of so short a memory by 0.3";
}

TEST(HydrophoneProcessor, DatesAMeasurementWithTheEndOfTheSoundThatItHeard) {
  HydrophoneProcessor processor(fin_whale_settings(), WakesFor::kMeasurements);
  Sea sea(processor);
  const double end_s = end_of_a_measurement_after(90.0);
  sea.call(20.0, end_s - 0.5, end_s + 5.0);  // half of the measurement: 3 dB less
  sea.hear_until(100.0);
  bool is_there = false;
  for (const messages::SnrMeasurement& measurement : measurements_of(processor)) {
    if (std::abs(seconds_since_beginning(measurement.time) - end_s) > 0.01) continue;
    is_there = true;
    EXPECT_NEAR(measurement.snr.value, 17.0, 1.0) << "a date that is wrong by 0.2 s is one of 1.5 dB or more";
  }
  EXPECT_TRUE(is_there);
}

TEST(HydrophoneProcessor, IsSetWhenThereIsAMeasurementAndInLockStepForEveryBlock) {
  HydrophoneProcessor at_sea(fin_whale_settings(), WakesFor::kMeasurements);
  Sea sea(at_sea);
  sea.hear();
  at_sea.clear();  // of the chain, which is told once
  sea.hear_until(10.0);
  EXPECT_FALSE(is_set(at_sea)) << "it does not know the noise yet";
  sea.hear_until(60.0);
  EXPECT_TRUE(is_set(at_sea));

  HydrophoneProcessor in_lock_step(fin_whale_settings(), WakesFor::kBlocks);
  Sea simulated(in_lock_step);
  simulated.hear();
  in_lock_step.clear();
  simulated.hear();
  EXPECT_TRUE(is_set(in_lock_step));
  EXPECT_EQ(in_lock_step.blocks_heard(), 2U);
}

TEST(HydrophoneProcessor, GivesNoMeasurementOfWhatItCannotHearAndSaysForHowLong) {
  HydrophoneProcessor processor(fin_whale_settings(), WakesFor::kMeasurements);
  Sea sea(processor);
  sea.hear_until(60.0);
  (void)measurements_of(processor);
  EXPECT_EQ(seconds(processor, Hearing::kDropout), 0.0);

  sea.skip(1);
  sea.hear_until(62.0);
  EXPECT_TRUE(measurements_of(processor).empty()) << "one sample is missing: the filters begin anew";
  EXPECT_GT(seconds(processor, Hearing::kDropout), 1.0);
  sea.hear_until(80.0);
  EXPECT_FALSE(measurements_of(processor).empty()) << "and what was known of the noise stays";

  sea.block().gain = Decibels{6};
  sea.hear_until(82.0);
  EXPECT_TRUE(measurements_of(processor).empty());
  EXPECT_GT(seconds(processor, Hearing::kGainChanged), 1.0);
  sea.hear_until(100.0);
  (void)measurements_of(processor);

  sea.offset = 1.0F;  // half of the noise's samples at full scale and more
  sea.hear_until(101.0);
  sea.offset = 0.0F;
  sea.hear_until(104.0);
  for (const messages::SnrMeasurement& measurement : measurements_of(processor)) {
    const double end_s = seconds_since_beginning(measurement.time);
    EXPECT_TRUE(end_s <= 100.01 || end_s >= 101.6) << end_s;
  }
  EXPECT_GE(seconds(processor, Hearing::kClipped) + seconds(processor, Hearing::kSaturated), 1.0);
  const std::string words = to_string(processor.heard());
  EXPECT_TRUE(support::has_line(words, {"samples", "missing", "samples", "lost"})) << words;
  EXPECT_TRUE(support::has_line(words, {"gain", "changed", "before", "search", "not"})) << words;
}

TEST(HydrophoneProcessor, SaysOnceThatItsHydrophoneIsDeafAndOnceThatItHearsAgain) {
  HydrophoneProcessor processor(fin_whale_settings(), WakesFor::kMeasurements);
  Sea sea(processor);
  messages::HydrophoneStatus status;
  sea.hear_until(20.0);
  EXPECT_FALSE(processor.take(status)) << "it hears, as everybody expects";
  sea.skip(1);
  sea.hear_until(21.0);
  EXPECT_FALSE(processor.take(status)) << "a lost sample is no deafness";
  sea.offset = 1.0F;  // half of the noise's samples at full scale and more
  sea.hear_until(30.0);
  ASSERT_TRUE(processor.take(status));
  EXPECT_TRUE(status.is_deaf);
  EXPECT_FALSE(processor.take(status));
  sea.offset = 0.0F;
  sea.hear_until(40.0);
  ASSERT_TRUE(processor.take(status));
  EXPECT_FALSE(status.is_deaf);
  EXPECT_FALSE(processor.take(status));
}

TEST(HydrophoneProcessor, HearsNothingWhileTheVehicleIsFasterThanItsGate) {
  detector::SoundSettings settings = fin_whale_settings();
  settings.gate.speed = MetersPerSecond{1.5};
  HydrophoneProcessor processor(settings, WakesFor::kMeasurements);
  Sea sea(processor);
  processor.note_speed(MetersPerSecond{1.5});
  sea.hear_until(60.0);
  EXPECT_FALSE(measurements_of(processor).empty());
  processor.note_speed(MetersPerSecond{1.6});
  sea.hear_until(70.0);
  EXPECT_TRUE(measurements_of(processor).empty());
  EXPECT_NEAR(seconds(processor, Hearing::kSelfNoise), 10.0, 0.3);
}

TEST(HydrophoneProcessor, TellsOfASoundOnceItIsOver) {
  HydrophoneProcessor processor(fin_whale_settings(), WakesFor::kMeasurements);
  Sea sea(processor);
  sea.call(20.0, 60.0, 63.0);
  sea.hear_until(63.0);
  messages::SoundDetection detection;
  EXPECT_FALSE(processor.take(detection)) << "it goes on";
  sea.hear_until(70.0);
  ASSERT_TRUE(processor.take(detection));
  EXPECT_NEAR(seconds_since_beginning(detection.begin), 60.0, 0.26) << "a quarter of the integration time";
  EXPECT_NEAR(detection.duration.to_seconds(), 3.0, 0.51);
  EXPECT_NEAR(detection.snr.value, 20.0, 1.5) << "the loudest of a dozen estimates";
  EXPECT_NEAR(detection.level.value, kNoise_db + 20.0, 1.5);
  EXPECT_FALSE(detection.is_clipped);
  EXPECT_FALSE(processor.take(detection));
  EXPECT_EQ(processor.heard().detections, 1U);
}

TEST(HydrophoneProcessor, SaysWithWhatChainItHearsAndAgainWhenThatChanges) {
  HydrophoneProcessor processor(fin_whale_settings(), WakesFor::kMeasurements);
  Sea sea(processor);
  sea.hear_until(1.0);
  HeardChain chain;
  ASSERT_TRUE(processor.take(chain));
  EXPECT_EQ(chain.heard, HeardChain::Heard::kWell);
  EXPECT_NEAR(chain.full_scale_level.value, 180.0, 1e-9);
  EXPECT_NEAR(chain.adc_noise_level.value, 15.51, 0.01) << "180 + 20 lg(2^-23) - 10 lg 12 + 10 lg(15 / 500) = 180 - 138.47 - 10.79 - 15.23";
  EXPECT_FALSE(processor.take(chain));
  sea.block().gain = Decibels{20};
  sea.hear_until(2.0);
  ASSERT_TRUE(processor.take(chain));
  EXPECT_NEAR(chain.full_scale_level.value, 160.0, 1e-9);
  EXPECT_FALSE(processor.take(chain));
}

TEST(HydrophoneProcessor, HearsNothingWithAChainOrARateThatCannotBeAndSaysWhy) {
  detector::SoundSettings settings = fin_whale_settings();
  settings.calibration.adc_bits = 8;
  settings.expected_noise = Decibels{90};  // 8 bits over 180 dB: their own noise is 106 dB in the band
  HydrophoneProcessor processor(settings, WakesFor::kMeasurements);
  Sea sea(processor);
  sea.hear_until(40.0);
  HeardChain chain;
  ASSERT_TRUE(processor.take(chain));
  EXPECT_EQ(chain.heard, HeardChain::Heard::kImpossibleChain);
  EXPECT_EQ(chain.fault, detector::CalibrationFault::kNoise);
  EXPECT_TRUE(measurements_of(processor).empty());
  EXPECT_NEAR(seconds(processor, Hearing::kImpossible), 40.0, 0.01);

  settings = fin_whale_settings();
  settings.band = {.low = Hertz{500}, .high = Hertz{600}};
  HydrophoneProcessor slow(settings, WakesFor::kMeasurements);
  Sea(slow).hear();
  ASSERT_TRUE(slow.take(chain));
  EXPECT_EQ(chain.heard, HeardChain::Heard::kRateTooLow);
}

TEST(HydrophoneProcessor, CountsMeasurementsThatNobodyTakes) {
  HydrophoneProcessor processor(fin_whale_settings(), WakesFor::kMeasurements);
  Sea(processor).hear_until(40.0 + static_cast<double>(config::kHydrophoneMeasurements));
  const HydrophoneProcessor::Account account = processor.heard();
  EXPECT_GT(account.left_out, 0U);
  EXPECT_EQ(measurements_of(processor).size() + account.left_out, account.measurements);
}

TEST(HydrophoneProcessor, WithoutSettingsCountsSamplesAndHearsNothing) {
  HydrophoneProcessor processor(std::nullopt, WakesFor::kMeasurements);
  Sea(processor).hear_until(60.0);
  EXPECT_EQ(processor.account().samples_heard, 60'000U);
  EXPECT_EQ(processor.blocks_heard(), 600U);
  EXPECT_TRUE(measurements_of(processor).empty());
}

/// One of a few values, among them those that break arithmetic.
double any_number(Pcg32& random) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr std::array kNumbers{0.0,      -1.0,  250.0,     1000.0,     48'000.0,
                                96'000.0, 1e300, kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()};
  return kNumbers.at(random.next() % kNumbers.size());
}

std::int64_t any_integer(Pcg32& random) {
  constexpr std::array<std::int64_t, 8> kNumbers{0,
                                                 1,
                                                 -1,
                                                 kBegan_us,
                                                 messages::kLastSample,
                                                 std::int64_t{1} << 60,
                                                 std::numeric_limits<std::int64_t>::max(),
                                                 std::numeric_limits<std::int64_t>::min()};
  return kNumbers.at(random.next() % kNumbers.size());
}

/// A message whose numbers are anything, of a length that fits them.
hydrophone_block_t any_block(Pcg32& random) {
  hydrophone_block_t block;
  block.utime = any_integer(random);
  block.sequence = any_integer(random);
  block.first_sample = any_integer(random);
  block.sample_rate_hz = any_number(random);
  block.gain_db = any_number(random);
  block.overflow_count = static_cast<std::int32_t>(random.next() % 3);
  block.channels = static_cast<std::int8_t>(random.next() % 9);
  block.sample_count = static_cast<std::int32_t>(random.next() % 300) * block.channels;
  block.samples.resize(static_cast<std::size_t>(block.sample_count));
  for (float& sample : block.samples) sample = static_cast<float>(any_number(random));
  return block;
}

TEST(HydrophoneProcessor, TakesMessagesThatSayAnythingAtAllAndHearsAgainAfterwards) {
  HydrophoneProcessor processor(fin_whale_settings(), WakesFor::kMeasurements);
  Pcg32 random(11);
  std::uint64_t readable = 0;
  for (int i = 0; i < 100'000; ++i) {
    const std::vector<std::uint8_t> bytes = support::encoded(any_block(random));
    wire::HydrophoneMessage message;
    if (wire::read_hydrophone_block(bytes, message) != Status::kOk) continue;
    std::vector<float> samples(message.sample_count());
    wire::copy_samples(message, samples);
    processor.hear(message.block, samples);
    ++readable;
    for (const messages::SnrMeasurement& measurement : measurements_of(processor)) EXPECT_TRUE(std::isfinite(measurement.snr.value));
  }
  EXPECT_GT(readable, 500U) << "most are refused as messages already";
  EXPECT_EQ(processor.blocks_heard(), readable);
  Sea(processor).hear_until(90.0);
  EXPECT_FALSE(measurements_of(processor).empty());
}

}  // namespace
}  // namespace earshot::board
