#include "firmware/host/mission/hydrophone_chain.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

/// Of hear_at_sea.toml: full scale 20 lg 2 + 170 = 176.02 dB re 1 uPa.
detector::SoundSettings at_sea() {
  detector::SoundSettings settings = detector::fin_whale();
  settings.calibration = {.sensitivity = Decibels{-170.0}, .full_scale_volts = 2.0, .adc_bits = 24};
  settings.expected_noise = Decibels{90.0};
  settings.detection_threshold = Decibels{10.0};
  return settings;
}

std::string reason_with_gain(double gain_db, double expected_noise_db = 90.0) {
  detector::SoundSettings settings = at_sea();
  settings.calibration.fixed_gain = Decibels{gain_db};
  settings.expected_noise = Decibels{expected_noise_db};
  return reason_for_deafness(settings);
}

// By hand: a step is 2 / 2^24 of full scale, -138.47 dB, and its error 10.79 dB less: 26.76 dB re 1 uPa up to half of the rate. Of this the
// band of 15 Hz has 30 / 96 000, -35.05 dB, or 30 / 250, -9.21 dB.
TEST(HydrophoneChain, LiesBetweenTheNoiseOfItsAdcAndFullScale) {
  const ChainRoom room = room_of(at_sea());
  EXPECT_NEAR(room.full_scale.value, 176.02, 0.01);
  EXPECT_NEAR(room.least_full_scale.value, 103.0, 1e-9) << "90, 10 for the threshold, 3 for a sine's peak";
  EXPECT_NEAR(room.adc_noise_at_highest_rate.value, -8.29, 0.01);
  EXPECT_NEAR(room.adc_noise_at_lowest_rate.value, 17.55, 0.01);
  EXPECT_EQ(room.lowest_rate, Hertz{250.0});
  EXPECT_EQ(reason_for_deafness(at_sea()), "");
}

TEST(HydrophoneChain, IsReadNoSlowerThanItsBandNeeds) {
  detector::SoundSettings settings = at_sea();
  settings.band = {.low = Hertz{400.0}, .high = Hertz{500.0}};
  EXPECT_NEAR(room_of(settings).lowest_rate.value, 1100.0, 1e-9);
}

// Full scale 176.02 less 73 is the 103 dB that the noise and a source at the threshold need.
TEST(HydrophoneChain, IsDeafWhereASourceAtTheThresholdClips) {
  EXPECT_EQ(reason_with_gain(73.0), "");
  EXPECT_TRUE(support::has_line(reason_with_gain(73.1), {"clip", "time", "102.9 dB", "needs 103", "needs less gain_db"}))
      << reason_with_gain(73.1);
  detector::SoundSettings settings = at_sea();
  settings.detection_threshold = Decibels{-10.0};
  EXPECT_NEAR(room_of(settings).least_full_scale.value, 100.0, 1e-9) << "the peaks of the noise itself";
}

// The ADC's noise at 96 kHz, -8.29 dB, comes within 3 dB of 90 dB with 95.29 dB less gain.
TEST(HydrophoneChain, IsDeafWhereTheSeaIsLessThanTheNoiseOfItsAdc) {
  EXPECT_EQ(reason_with_gain(-95.2), "");
  EXPECT_TRUE(support::has_line(reason_with_gain(-95.4), {"ADC", "87.1 dB", "96000 Hz", "90", "needs", "gain_db", "adc_bits"}))
      << reason_with_gain(-95.4);
  detector::SoundSettings eight_bits = at_sea();
  eight_bits.calibration.adc_bits = 8;  // 16 bits are 96.33 dB: -8.29 + 96.33 = 88.04
  EXPECT_NE(reason_for_deafness(eight_bits).find("is 88 dB re 1 uPa"), std::string::npos) << reason_for_deafness(eight_bits);
}

TEST(HydrophoneChain, IsJudgedByTheSeasThatThereAreWhereNoneIsExpected) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reason_with_gain(143.0, kUnknown), "") << "33 dB for 20 dB of noise";
  EXPECT_NE(reason_with_gain(143.1, kUnknown).find("the noise of the quietest sea"), std::string::npos);
  EXPECT_EQ(reason_with_gain(-155.2, kUnknown), "");
  EXPECT_NE(reason_with_gain(-155.4, kUnknown).find("the loudest sea has 150"), std::string::npos);
}

}  // namespace
}  // namespace earshot::host
