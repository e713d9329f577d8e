#include "sim/spectrum/spectrogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace earshot::spectrum {

Spectrogram::Spectrogram(std::uint64_t samples, const ShortTimeSpectrum& windows, Hertz highest) : window_(windows.length()) {
  const double bins = std::min(highest / windows.bin_width(), static_cast<double>(windows.bins() - 1));
  const auto shown = static_cast<std::size_t>(std::max(bins, 0.0)) + 1;
  bins_per_row_ = (shown + kMostRows - 1) / kMostRows;
  rows_ = shown / bins_per_row_;
  hertz_per_row_ = static_cast<double>(bins_per_row_) * windows.bin_width();
  columns_ = static_cast<std::size_t>(std::clamp<std::uint64_t>(samples / windows.hop(), 1, kMostColumns));
  samples_per_column_ = static_cast<double>(samples) / static_cast<double>(columns_);
  seconds_per_column_ = samples_per_column_ / windows.sample_rate().value;
  sum_.assign(columns_ * rows_, 0.0);
  windows_.assign(columns_, 0);
}

void Spectrogram::take(std::span<const float> psd, std::uint64_t begin) {
  const double middle = static_cast<double>(begin) + 0.5 * static_cast<double>(window_);
  const std::size_t column = std::min(static_cast<std::size_t>(middle / samples_per_column_), columns_ - 1);
  if (!std::isfinite(psd.front())) return;
  ++windows_[column];
  for (std::size_t row = 0; row < rows_; ++row) {
    double sum = 0.0;
    for (std::size_t i = 0; i < bins_per_row_; ++i) sum += static_cast<double>(psd[row * bins_per_row_ + i]);
    sum_[column * rows_ + row] += sum / static_cast<double>(bins_per_row_);
  }
}

Hertz Spectrogram::frequency_of(std::size_t row) const {
  // A row's first bin lies about its own frequency, not above it.
  const double bins = static_cast<double>(bins_per_row_);
  return (static_cast<double>(row) + 0.5 * (bins - 1.0) / bins) * hertz_per_row_;
}

double Spectrogram::level_db(std::size_t column, std::size_t row) const {
  const double power = windows_[column] == 0 ? 0.0 : sum_[column * rows_ + row] / static_cast<double>(windows_[column]);
  return power > 0.0 ? 10.0 * std::log10(power) : std::numeric_limits<double>::quiet_NaN();
}

double Spectrogram::percentile_db(double percent, Hertz lowest) const {
  std::vector<double> levels;
  const auto first = static_cast<std::size_t>(lowest / hertz_per_row_);
  for (std::size_t column = 0; column < columns_; ++column)
    for (std::size_t row = first; row < rows_; ++row)
      if (const double level = level_db(column, row); std::isfinite(level)) levels.push_back(level);
  if (levels.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto at = levels.begin() + static_cast<std::ptrdiff_t>(percent / 100.0 * static_cast<double>(levels.size() - 1));
  std::ranges::nth_element(levels, at);
  return *at;
}

}  // namespace earshot::spectrum
