#include "firmware/detector/hydrophone/calibration.hpp"

#include "firmware/core/decibels.hpp"

namespace earshot::detector {
namespace {

constexpr Decibels kLeastSensitivity{-260.0};
constexpr Decibels kMostSensitivity{-100.0};
constexpr Decibels kMostGain{200.0};
constexpr double kLeastVolts = 1e-6;
constexpr double kMostVolts = 1e3;
constexpr int kFewestBits = 8;
constexpr int kMostBits = 32;
constexpr double kSquaredStepOverNoise = 12.0;  ///< of an error that is even over a step

}  // namespace

Decibels full_scale_level(const Calibration& calibration, Decibels block_gain) {
  return level_of(calibration.full_scale_volts * calibration.full_scale_volts) - calibration.sensitivity - calibration.fixed_gain -
         block_gain;
}

Decibels adc_noise_level(const Calibration& calibration, Decibels block_gain, Hertz sample_rate, Band band) {
  const double step = 2.0 / static_cast<double>(std::int64_t{1} << calibration.adc_bits);
  const double share = 2.0 * band.width().value / sample_rate.value;
  return full_scale_level(calibration, block_gain) + level_of(step * step / kSquaredStepOverNoise * share);
}

CalibrationFault check(const Calibration& calibration, Decibels block_gain, Hertz sample_rate, Band band, Decibels expected_noise) {
  const Decibels gain = calibration.fixed_gain + block_gain;
  if (!(calibration.sensitivity >= kLeastSensitivity) || !(calibration.sensitivity <= kMostSensitivity))
    return CalibrationFault::kSensitivity;
  if (!(gain >= -kMostGain) || !(gain <= kMostGain)) return CalibrationFault::kGain;
  if (!(calibration.full_scale_volts >= kLeastVolts) || !(calibration.full_scale_volts <= kMostVolts)) return CalibrationFault::kFullScale;
  if (calibration.adc_bits < kFewestBits || calibration.adc_bits > kMostBits) return CalibrationFault::kBits;
  if (!(calibration.high_pass_corner.value >= 0.0) || !(calibration.high_pass_corner <= band.low)) return CalibrationFault::kHighPassCorner;
  if (adc_noise_level(calibration, block_gain, sample_rate, band) > expected_noise) return CalibrationFault::kNoise;
  return CalibrationFault::kNone;
}

const char* to_string(CalibrationFault fault) {
  switch (fault) {
    case CalibrationFault::kNone:
      return "nothing is wrong with the calibration";
    case CalibrationFault::kSensitivity:
      return "the hydrophone's sensitivity must lie from -260 to -100 dB re 1 V/uPa: it is negative (-180, not 180)";
    case CalibrationFault::kGain:
      return "the gains together must lie from -200 to 200 dB";
    case CalibrationFault::kFullScale:
      return "the ADC's full scale must lie from 1e-6 to 1000 V";
    case CalibrationFault::kBits:
      return "the ADC must have 8 to 32 bits";
    case CalibrationFault::kHighPassCorner:
      return "the chain's high-pass corner must not be negative nor above the band's low end: the band would not be heard whole";
    case CalibrationFault::kNoise:
      return "the ADC's own noise in the band lies above the ambient noise that is expected there: the chain needs more gain or bits";
  }
  return "?";
}

}  // namespace earshot::detector
