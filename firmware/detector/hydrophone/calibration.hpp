#pragma once

#include <cstdint>

#include "firmware/core/status.hpp"
#include "firmware/core/units.hpp"

namespace earshot::detector {

/// Frequencies that are listened to.
struct Band {
  Hertz low{15.0};
  Hertz high{30.0};
  friend constexpr bool operator==(const Band&, const Band&) = default;
  [[nodiscard]] constexpr Hertz width() const { return high - low; }
};

/// From pressure in the water to numbers: hydrophone, amplifier, ADC. Gain that a block of samples names comes on top of the fixed gain.
struct Calibration {
  Decibels sensitivity{-180.0};   ///< of the hydrophone, dB re 1 V/uPa
  Decibels fixed_gain{0.0};       ///< of what amplifies whatever the block says
  double full_scale_volts = 1.0;  ///< at the ADC's input, of a sample of 1.0: half of the range from peak to peak
  int adc_bits = 24;              ///< that carry signal: quantisation is taken as the ADC's only noise
  Hertz high_pass_corner{0.0};    ///< of the chain, -3 dB; 0: none
};

/// What is wrong with a chain.
enum class CalibrationFault : std::uint8_t {
  kNone,
  kSensitivity,     ///< not negative, or of no hydrophone: -260 to -100 dB re 1 V/uPa
  kGain,            ///< fixed and block's gain together beyond +-200 dB, or not finite
  kFullScale,       ///< not 1 uV to 1 kV
  kBits,            ///< not 8 to 32
  kHighPassCorner,  ///< negative, or above the band's low end: the band is not heard whole
  kNoise,           ///< the ADC's noise in the band lies above the ambient noise that is expected there
};

/// "the hydrophone's sensitivity is no number from -260 to -100 dB re 1 V/uPa ..."
[[nodiscard]] const char* to_string(CalibrationFault fault);

/// Level of a sample of 1.0, dB re 1 uPa peak (a sine of full scale has 3.01 dB less, root mean square).
///
///   full scale = 20 lg(volts) - sensitivity - gain
///
/// @param block_gain  dB, as messages::HydrophoneBlock::gain
/// Oracle: Calibration.PutsFullScaleWhereTheDataSheetDoes
[[nodiscard]] Decibels full_scale_level(const Calibration& calibration, Decibels block_gain);

/// Level of the ADC's own noise in a band, dB re 1 uPa: steps of 2 volts / 2^bits, even over each, white up to half the sample rate.
///
///   noise = full scale + 10 lg(step^2 / 12 * width / (rate / 2)),   step = 2 / 2^bits
///
/// Source: Bennett 1948, Spectra of quantized signals, Bell Syst. Tech. J. 27.   Oracle: Calibration.PutsSixteenBitsNoiseWhereBennettDoes
[[nodiscard]] Decibels adc_noise_level(const Calibration& calibration, Decibels block_gain, Hertz sample_rate, Band band);

/// @param expected_noise  ambient noise in the band, dB re 1 uPa; NaN where nothing is known of it
[[nodiscard]] CalibrationFault check(const Calibration& calibration, Decibels block_gain, Hertz sample_rate, Band band,
                                     Decibels expected_noise);

}  // namespace earshot::detector
