#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/spectrum/third_octaves.hpp"

namespace earshot::spectrum {

/// Of the levels of one interval's windows: how many per cent of them are no higher.
inline constexpr std::array<double, 5> kPercentiles{5.0, 25.0, 50.0, 75.0, 95.0};

/// Levels in third octaves over time: for each interval the level of the mean power, and percentiles of its windows' levels.
/// Oracle: BandLevels.*
class BandLevels {
 public:
  /// @param interval  samples from the begin of one to that of the next
  BandLevels(std::vector<ThirdOctave> bands, Hertz bin_width, std::uint64_t interval);

  /// @param psd  as ShortTimeSpectrum gives it; @param begin  of its window, never less than before
  void take(std::span<const float> psd, std::uint64_t begin);
  /// After the last window.
  void finish();

  [[nodiscard]] const std::vector<ThirdOctave>& bands() const { return bands_; }
  [[nodiscard]] const std::vector<std::uint64_t>& begins() const { return begins_; }  ///< of the intervals that hold a window
  /// dB re 1 unit, [n_interval x n_band]
  [[nodiscard]] const std::vector<float>& mean_level_db() const { return mean_level_db_; }
  /// dB re 1 unit, [n_interval x n_percentile x n_band]
  [[nodiscard]] const std::vector<float>& percentile_level_db() const { return percentile_level_db_; }

 private:
  std::vector<ThirdOctave> bands_;
  Hertz bin_width_;
  std::uint64_t interval_;
  std::uint64_t current_ = 0;               ///< number of the interval
  std::vector<std::vector<float>> powers_;  ///< [n_band] of this interval's windows
  std::vector<std::uint64_t> begins_;
  std::vector<float> mean_level_db_;
  std::vector<float> percentile_level_db_;
};

}  // namespace earshot::spectrum
