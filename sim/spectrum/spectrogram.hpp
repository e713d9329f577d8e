#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/spectrum/short_time_spectrum.hpp"

namespace earshot::spectrum {

/// Mean density over time and frequency, of no more columns and rows than a picture shows, whatever the length of the sound.
/// Oracle: Spectrogram.*
class Spectrogram {
 public:
  static constexpr std::size_t kMostColumns = 1000;
  static constexpr std::size_t kMostRows = 256;

  /// @param samples  of the sound as a whole; highest  frequency of the picture
  Spectrogram(std::uint64_t samples, const ShortTimeSpectrum& windows, Hertz highest);

  /// As a sink of those windows.
  void take(std::span<const float> psd, std::uint64_t begin);

  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] double seconds_per_column() const { return seconds_per_column_; }
  [[nodiscard]] Hertz hertz_per_row() const { return hertz_per_row_; }
  /// The middle of what a row is the mean of.
  [[nodiscard]] Hertz frequency_of(std::size_t row) const;
  /// dB re 1 unit^2/Hz; NaN where no sound was.
  [[nodiscard]] double level_db(std::size_t column, std::size_t row) const;
  /// So many per cent of all levels from this frequency up are lower; NaN where none is.
  [[nodiscard]] double percentile_db(double percent, Hertz lowest) const;

 private:
  std::size_t window_;  ///< samples
  std::size_t columns_;
  std::size_t bins_per_row_;
  std::size_t rows_;
  double samples_per_column_;
  double seconds_per_column_;
  Hertz hertz_per_row_;
  std::vector<double> sum_;             ///< [n_column x n_row]
  std::vector<std::uint32_t> windows_;  ///< [n_column]
};

}  // namespace earshot::spectrum
