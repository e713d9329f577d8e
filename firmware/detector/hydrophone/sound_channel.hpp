#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/detector/hydrophone/band_pass.hpp"
#include "firmware/detector/hydrophone/estimate.hpp"
#include "firmware/detector/hydrophone/fir_decimator.hpp"
#include "firmware/detector/hydrophone/listening_plan.hpp"
#include "firmware/detector/hydrophone/noise_floor.hpp"

namespace earshot::detector {

/// Powers that turn shares of full scale into dB re 1 uPa, and what a chain lets through of its own.
struct ChainLevels {
  double full_scale_power = 1.0;  ///< uPa^2 of a sample of 1.0
  double open_power = 0.0;        ///< uPa^2 in the band: no more than twice the ADC's own noise
  double flow_power = 0.0;        ///< uPa^2 in the band: a floor above is not the ambient expected; infinity where nothing is expected
  float clip = 1.0F;              ///< shares: a sample from here on is at full scale
};

/// What one channel heard over an integration time, in uPa^2.
struct ChannelPowers {
  Hearing hearing = Hearing::kFillingUp;
  double power = 0.0;                        ///< in the band
  double noise = 0.0;                        ///< the floor
  std::array<double, kQuarters> quarters{};  ///< power in the band, the oldest first
};

/// One channel's filters and noise floor.
class SoundChannel {
 public:
  void configure(const ListeningPlan& plan);
  /// The filters begin anew; what is known of the noise stays.
  void begin();

  /// @param samples  the channel's first; stride  from one of its samples to the next
  void feed(const ListeningPlan& plan, const ChainLevels& levels, const float* samples, std::size_t stride, std::size_t count);

  /// Ends a quarter of the integration time.
  void end_quarter(const ListeningPlan& plan);

  /// Over the last four quarters. @param floor_needed  powers that the floor must know
  [[nodiscard]] ChannelPowers powers(const ListeningPlan& plan, const ChainLevels& levels, std::size_t floor_needed) const;

  /// Once for each integration time, after powers(): its sound is noise that the next may be held against.
  /// @param hearing  over that time: what was in the way is not learnt from
  void learn(const ListeningPlan& plan, const ChainLevels& levels, Hearing hearing);

 private:
  /// Over a quarter of the integration time, in squared shares of full scale.
  struct Quarter {
    float band = 0.0F;
    float below = 0.0F;
    float above = 0.0F;
    Hearing hearing = Hearing::kHears;
  };
  /// Of the samples in the quarter under way.
  struct Account {
    std::size_t samples = 0;
    std::size_t at_full_scale = 0;
    bool has_nan = false;
    float lowest = 0.0F;
    float highest = 0.0F;
  };

  void take_in(const ChainLevels& levels, const float* samples, std::size_t stride, std::size_t count, float* room);
  void add_powers(const ListeningPlan& plan, std::size_t count);
  [[nodiscard]] Hearing hearing_of_samples() const;
  [[nodiscard]] double noise_power(const ListeningPlan& plan, const ChainLevels& levels) const;
  [[nodiscard]] bool is_flow_noise(const ListeningPlan& plan, const ChainLevels& levels) const;

  FirHistory<config::kFirTaps> first_;
  FirHistory<config::kSecondFirTaps> second_;
  BandPass band_;
  BandPass below_;
  BandPass above_;
  std::array<float, config::kSoundChunk> low_{};  ///< low-rate samples of the go under way
  std::array<float, config::kSoundChunk> filtered_{};
  Quarter now_;
  std::array<Quarter, kQuarters + 1> last_{};  ///< the newest first; one more, whose troubles the filters' delay carries over
  Account account_;
  float reference_ = 0.0F;  ///< the first sample: the filters are given the difference, so that a constant voltage makes no step
  float good_ = 0.0F;       ///< the last sample that was a number
  bool has_reference_ = false;
  NoiseFloor floor_;
  std::optional<float> learning_;  ///< the last integration time's noise, which the one under way must not be held against yet
};

}  // namespace earshot::detector
