#include "firmware/detector/hydrophone/calibration.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string_view>

#include "tests/firmware/not_finite.hpp"

namespace earshot::detector {
namespace {

constexpr Band kBand{.low = Hertz{15}, .high = Hertz{30}};
constexpr Decibels kNothingExpected{std::numeric_limits<double>::quiet_NaN()};
constexpr Decibels kNoGain{0.0};
using tests::kNan;

CalibrationFault fault_of(const Calibration& calibration, Decibels gain = kNoGain, Decibels expected = kNothingExpected) {
  return check(calibration, gain, Hertz{48'000}, kBand, expected);
}

// By hand: an RTsys-like chain: -180 dB re 1 V/uPa, 20 dB of gain, +-2.5 V: 20 lg 2.5 = 7.959 dB re 1 V; 7.959 + 180 - 20 = 167.959.
TEST(Calibration, PutsFullScaleWhereTheDataSheetDoes) {
  const Calibration chain{.sensitivity = Decibels{-180}, .fixed_gain = Decibels{14}, .full_scale_volts = 2.5};
  EXPECT_NEAR(full_scale_level(chain, Decibels{6}).value, 167.9588, 1e-4);
}

// By hand: 2 / 2^16 = 3.0518e-5; squared over 12: 7.7610e-11, -101.101 dB; 15 Hz of 24 kHz: -32.041 dB; 180 dB full scale: 46.858.
TEST(Calibration, PutsSixteenBitsNoiseWhereBennettDoes) {
  const Calibration chain{.adc_bits = 16};
  EXPECT_NEAR(adc_noise_level(chain, kNoGain, Hertz{48'000}, kBand).value, 46.858, 1e-3);
}

TEST(Calibration, FindsNothingWrongWithAUsualChain) {
  EXPECT_EQ(fault_of({}), CalibrationFault::kNone);
  EXPECT_EQ(fault_of({.sensitivity = Decibels{-201},
                      .fixed_gain = Decibels{40},
                      .full_scale_volts = 3.0,
                      .adc_bits = 16,
                      .high_pass_corner = Hertz{10}},
                     Decibels{-6}, Decibels{90}),
            CalibrationFault::kNone);
}

TEST(Calibration, RefusesAChainThatCannotBe) {
  EXPECT_EQ(fault_of({.sensitivity = Decibels{180}}), CalibrationFault::kSensitivity) << "the wrong sign";
  EXPECT_EQ(fault_of({.sensitivity = Decibels{0}}), CalibrationFault::kSensitivity);
  EXPECT_EQ(fault_of({.sensitivity = Decibels{kNan}}), CalibrationFault::kSensitivity);
  EXPECT_EQ(fault_of({.fixed_gain = Decibels{190}}, Decibels{20}), CalibrationFault::kGain);
  EXPECT_EQ(fault_of({}, Decibels{kNan}), CalibrationFault::kGain);
  EXPECT_EQ(fault_of({.full_scale_volts = 0.0}), CalibrationFault::kFullScale);
  EXPECT_EQ(fault_of({.full_scale_volts = kNan}), CalibrationFault::kFullScale);
  EXPECT_EQ(fault_of({.adc_bits = 7}), CalibrationFault::kBits);
  EXPECT_EQ(fault_of({.adc_bits = 64}), CalibrationFault::kBits);
  EXPECT_EQ(fault_of({.high_pass_corner = Hertz{15.1}}), CalibrationFault::kHighPassCorner) << "above the band's low end";
  EXPECT_EQ(fault_of({.high_pass_corner = Hertz{-1}}), CalibrationFault::kHighPassCorner);
}

TEST(Calibration, RefusesAnAdcLouderThanTheSeaIsExpectedToBe) {
  const Calibration eight_bits{.adc_bits = 8};  // 46.858 dB at 16 bits, 6.0206 dB more for each that is missing: 95.02 dB
  EXPECT_EQ(fault_of(eight_bits, kNoGain, Decibels{95.1}), CalibrationFault::kNone);
  EXPECT_EQ(fault_of(eight_bits, kNoGain, Decibels{95.0}), CalibrationFault::kNoise);
  EXPECT_EQ(fault_of(eight_bits, Decibels{10}, Decibels{95.0}), CalibrationFault::kNone) << "more gain, less of its noise in the water";
}

TEST(Calibration, SaysEveryFaultInWordsOfItsOwn) {
  for (int a = 0; a <= static_cast<int>(CalibrationFault::kNoise); ++a) {
    for (int b = 0; b < a; ++b)
      EXPECT_NE(std::string_view(to_string(static_cast<CalibrationFault>(a))), to_string(static_cast<CalibrationFault>(b)));
  }
}

}  // namespace
}  // namespace earshot::detector
