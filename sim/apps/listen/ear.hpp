#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "sim/recording/sequence.hpp"

namespace earshot::listen {

/// The vehicle's detector, listening to one channel of a recording. Dates are those of the sequence: from its start.
class Ear {
 public:
  /// @param settings  check() finds no fault
  Ear(const detector::SoundSettings& settings, Hertz sample_rate);

  /// To be given the beginning of the recording, as much as the noise floor remembers, before all of it: see
  /// SoundDetector::begin_again_knowing_the_noise. What it hears now is not told.
  void learn_noise(const recording::Piece& piece);
  void hear(const recording::Piece& piece);
  void finish();

  [[nodiscard]] const std::vector<detector::Detection>& detections() const { return detections_; }
  /// How long it was so: about a quarter of the integration time for each estimate.
  [[nodiscard]] Duration time_of(detector::Hearing hearing) const;
  /// How long it measured: heard, or heard clipped sound.
  [[nodiscard]] Duration listened() const;
  /// What stood in the way the longest; kHears where nothing did.
  [[nodiscard]] detector::Hearing main_obstacle() const;
  /// Noise in the band, the mean of the floor's levels, dB re 1 uPa; NaN where it was never known.
  [[nodiscard]] Decibels mean_floor() const;
  [[nodiscard]] const detector::SoundSettings& settings() const { return settings_; }

 private:
  void give(const recording::Piece& piece);

  detector::SoundSettings settings_;
  Hertz sample_rate_;
  std::unique_ptr<detector::SoundDetector> detector_;  // some 200 kB
  bool is_learning_ = false;
  std::int64_t sequence_ = 0;
  std::int64_t skipped_samples_ = 0;  ///< that the counter of samples runs ahead, one for each place where sound does not go on
  std::vector<detector::Detection> detections_;
  std::array<std::uint64_t, detector::kHearings> estimates_{};
  double floor_sum_db_ = 0.0;
  std::uint64_t floors_ = 0;
};

}  // namespace earshot::listen
