#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/snr_measurement.hpp"

namespace earshot::detector {

/// Whether sound was heard, or what was in the way. Of several the last here counts.
enum class Hearing : std::uint8_t {
  kHears,
  kFloorUnsettled,  ///< too little has been heard to know the noise
  kFillingUp,       ///< the filters and the integration time are not full yet: the beginning
  kFlowNoise,       ///< the noise is far above the ambient expected, and falls with frequency
  kSelfNoise,       ///< the gate: speed or thruster
  kClipped,         ///< samples at full scale
  kGainChanged,
  kDropout,     ///< samples are missing
  kOpen,        ///< nothing but the ADC's own noise: the hydrophone is open or its amplifier dead
  kStuck,       ///< every sample alike: shorted, or no ADC
  kSaturated,   ///< half of the samples at full scale
  kNotANumber,  ///< NaN or infinite samples
  kImpossible,  ///< the chain or the sample rate cannot give this band: CalibrationFault, kLeastRateOverBand
};
inline constexpr std::size_t kHearings = 13;

/// "clipped"
[[nodiscard]] const char* to_string(Hearing hearing);

/// Whether the hydrophone itself, its cable or its ADC is in the way, so that nothing at sea could be heard. Nothing: it cannot be told
/// from this, as at the beginning, where samples are missing, or when the gain has just changed.
[[nodiscard]] std::optional<bool> is_deaf(Hearing hearing);

/// One channel over one integration time.
struct ChannelEstimate {
  Hearing hearing = Hearing::kFillingUp;
  Decibels level;  ///< in the band, signal and noise, dB re 1 uPa root mean square
  Decibels floor;  ///< of the noise in the band, dB re 1 uPa root mean square; with kFloorUnsettled: the best guess so far
};

/// What began and ended.
struct Detection {
  Time begin;
  Duration duration;
  Decibels peak_level;              ///< estimate of the highest SNR: signal and noise in the band, dB re 1 uPa
  Decibels peak_snr;                ///< its SNR
  Time peak;                        ///< end of its interval
  Hearing worst = Hearing::kHears;  ///< of the estimates in it: kHears or kClipped
  std::uint32_t estimates = 0;      ///< that reached the threshold
};

/// What was heard over one integration time: one comes every quarter of it.
///
///   SNR = 10 lg((P - N) / N)
///
/// P is the mean power in the band over the integration time (signal and noise together), N the mean power of noise alone as the floor has
/// it: the signal's own level minus the noise level, as the passive sonar equation has it (SL - TL - N, sim/sonar), and not P / N, which
/// would be 0.4 dB more at 10 dB and 3 dB more at 0 dB. With several channels P / N is the mean over those that hear, each over its own
/// floor.
struct Estimate {
  Time time;                              ///< end of the interval at the hydrophone: the filters' delay is taken off
  Hearing hearing = Hearing::kFillingUp;  ///< of the channel that hears best
  bool is_independent = false;            ///< shares no sound with the last estimate that said so: for statistics
  Decibels snr;                           ///< with too_faint: the least that can be measured; NaN unless is_measured() or kClipped
  bool too_faint = false;                 ///< noise alone is as loud once in a thousand independent estimates, or louder
  bool reaches_threshold = false;
  Decibels level;  ///< dB re 1 uPa, mean power of the channels that hear best; NaN where snr is
  Decibels floor;  ///< dB re 1 uPa, likewise
  std::uint8_t channel_count = 0;
  std::array<ChannelEstimate, config::kHydrophoneChannels> channels{};  ///< of which channel_count are there
  std::optional<Detection> ended;                                       ///< a detection that is over now

  /// Whether it hears, and knows the noise.
  [[nodiscard]] constexpr bool is_measured() const { return hearing == Hearing::kHears; }
  /// Whether it is an SNR measurement that a policy may take. Belief and training take measurements as independent: the four estimates of
  /// an integration time would count the same noise four times.
  [[nodiscard]] constexpr bool is_snr_measurement() const { return is_measured() && is_independent; }
  /// @pre is_measured()
  [[nodiscard]] constexpr messages::SnrMeasurement measurement() const { return {.time = time, .snr = snr, .too_faint = too_faint}; }
};

}  // namespace earshot::detector
