#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/listening/channel_detector.hpp"
#include "sim/listening/decimator.hpp"
#include "sim/listening/plan.hpp"
#include "sim/recording/sequence.hpp"
#include "sim/spectrum/band_levels.hpp"
#include "sim/spectrum/short_time_spectrum.hpp"
#include "sim/spectrum/spectrogram.hpp"

namespace earshot::listening {

/// What is wanted of a recording besides its detections.
struct Wanted {
  bool every_threshold = false;  ///< detections at each threshold of a curve as well
  bool spectrogram = false;
  std::optional<double> levels_interval_s{};  ///< of third-octave levels
};

/// Everything that hears a recording at once: detectors, spectrogram, levels.
class ChannelDetectors {
 public:
  /// @param plan  stays as long as this
  ChannelDetectors(const Plan& plan, const Wanted& wanted);

  /// Samples of the recording.
  [[nodiscard]] std::size_t lead() const { return (channel_detector_.lead() + reach()) * decimator_.factor(); }
  [[nodiscard]] std::size_t tail() const { return (channel_detector_.tail() + reach()) * decimator_.factor(); }

  // As those of ChannelDetector, of samples at the recording's own rate.
  void prepare(std::span<const float> before);
  void learn_noise(const recording::Piece& piece);
  void begin_again();
  void hear(const recording::Piece& piece);
  void finish(std::span<const float> after);

  [[nodiscard]] const ChannelDetector& channel_detector() const { return channel_detector_; }
  [[nodiscard]] const std::vector<ChannelDetector>& others() const { return others_; }
  [[nodiscard]] const spectrum::BandLevels* levels() const { return levels_.get(); }
  [[nodiscard]] std::unique_ptr<spectrum::Spectrogram> take_spectrogram() { return std::move(spectrogram_); }
  [[nodiscard]] std::unique_ptr<spectrum::BandLevels> take_levels() { return std::move(levels_); }

 private:
  [[nodiscard]] std::size_t reach() const { return decimator_.factor() == 1 ? 0 : 2 * Decimator::kReach; }
  [[nodiscard]] std::span<const float> at_listening_rate(std::span<const float> samples);
  /// Nothing where the piece completes no sample.
  [[nodiscard]] std::optional<recording::Piece> at_listening_rate(const recording::Piece& piece);
  template <typename Do>
  void for_each(Do what);

  Decimator decimator_;
  std::uint64_t next_lower_ = 0;  ///< number of the sample that the decimator gives next
  bool is_broken_ = false;        ///< it does not follow on the last
  ChannelDetector channel_detector_;
  std::vector<ChannelDetector> others_;
  spectrum::ShortTimeSpectrum picture_windows_;
  spectrum::ShortTimeSpectrum level_windows_;
  std::unique_ptr<spectrum::Spectrogram> spectrogram_;
  std::unique_ptr<spectrum::BandLevels> levels_;
};

}  // namespace earshot::listening
