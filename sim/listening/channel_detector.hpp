#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "sim/recording/sequence.hpp"

namespace earshot::listening {

/// The vehicle's detector, listening to one channel of a recording. Dates are those of the sequence: from its start.
class ChannelDetector {
 public:
  /// @param settings  check() finds no fault
  ChannelDetector(const detector::SoundSettings& settings, Hertz sample_rate);

  /// Samples that the filters need before the first: given to prepare(), they have forgotten their own beginning when the sound begins.
  [[nodiscard]] std::size_t lead() const;
  /// Samples after the last that bring the recording's own through the filters.
  [[nodiscard]] std::size_t tail() const;

  /// Once before each hearing of the recording, or not at all. @param before  lead() samples of what stands for the sound before the
  /// recording: nothing is detected in it
  void prepare(std::span<const float> before);
  /// To be given the beginning of the recording, as much as the noise floor remembers, before all of it: see
  /// SoundDetector::begin_again_knowing_the_noise. What it hears now is not told.
  void learn_noise(const recording::Piece& piece);
  /// Ends the learning.
  void begin_again();
  void hear(const recording::Piece& piece);
  /// @param after  what stands for the sound after the recording, or nothing: nothing is detected in it
  void finish(std::span<const float> after);

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
  void give(std::span<const float> samples, std::int64_t first);
  void draw(Time end);
  void finish_detection();
  [[nodiscard]] Time time_at(std::int64_t sample) const;

  detector::SoundSettings settings_;
  Hertz sample_rate_;
  detector::ListeningPlan plan_;
  std::unique_ptr<detector::SoundDetector> detector_;  // some 200 kB
  std::int64_t sequence_ = 0;
  std::int64_t next_ = 0;             ///< sample of the recording
  std::int64_t skipped_samples_ = 0;  ///< that the counter of samples runs ahead, one for each place where sound does not go on
  std::vector<detector::Detection> detections_;
  std::array<std::uint64_t, detector::kHearings> estimates_{};
  double floor_sum_db_ = 0.0;
  std::uint64_t floors_ = 0;
};

}  // namespace earshot::listening
