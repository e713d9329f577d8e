#pragma once

#include <cstddef>

#include "firmware/core/status.hpp"
#include "firmware/core/units.hpp"
#include "firmware/detector/hydrophone/band_pass.hpp"
#include "firmware/detector/hydrophone/fir_decimator.hpp"
#include "firmware/detector/hydrophone/settings.hpp"

namespace earshot::detector {

inline constexpr std::size_t kQuarters = 4;  ///< of an integration time: one estimate each

/// How sound of one sample rate is listened to: filters and lengths, the same for every channel. What a block's rate asks for, worked out
/// once.
struct ListeningPlan {
  Hertz sample_rate;
  Hertz low_rate;  ///< after both decimators: 4 to 8 times the highest frequency listened to, less where the sample rate is
  FirDesign first;
  FirDesign second;
  BandPassDesign band;
  BandPassDesign below;  ///< under the band: the lower flank, or where flow noise would show
  BandPassDesign above;  ///< the upper flank
  bool has_below = false;
  bool has_above = false;
  double below_width_hz = 0.0;  ///< of its noise
  double above_width_hz = 0.0;
  double band_width_hz = 0.0;
  double flank_weight = 0.5;  ///< of the lower flank's level in the band's, in dB: by the distance on a logarithmic axis of frequency
  std::size_t quarter = 1;    ///< low-rate samples in a quarter of the integration time
  std::size_t settling_quarters = 0;  ///< after a beginning, until the filters have forgotten it
  double delay_s = 0.0;               ///< of all filters together
  double degrees_of_freedom = 1.0;    ///< of noise over the integration time
  double least_ratio = 1.0;           ///< P / N that noise alone reaches once in a thousand integration times
  std::size_t floor_memory = 1;       ///< integration times

  /// Samples of one channel that make one low-rate sample.
  [[nodiscard]] std::size_t factor() const { return first.factor * second.factor; }
};

/// @param settings  check() has found no fault
/// @return kUnsupported where the sample rate is below kLeastRateOverBand times the highest frequency listened to, or beyond an ADC's
[[nodiscard]] Status make_plan(const SoundSettings& settings, Hertz sample_rate, ListeningPlan& plan);

/// Bands beside a band: a quarter of its width away, as wide as it.
[[nodiscard]] Band lower_flank(Band band);
[[nodiscard]] Band upper_flank(Band band);

}  // namespace earshot::detector
