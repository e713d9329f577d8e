#include "sim/spectrum/band_levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace earshot::spectrum {
namespace {

float level_of(double power) {
  return power > 0.0 ? static_cast<float>(10.0 * std::log10(power)) : -std::numeric_limits<float>::infinity();
}

/// Of sorted powers, between two of them in proportion.
double quantile(std::span<const float> sorted, double percent) {
  const double at = percent / 100.0 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double share = at - static_cast<double>(below);
  return (1.0 - share) * static_cast<double>(sorted[below]) + share * static_cast<double>(sorted[above]);
}

}  // namespace

BandLevels::BandLevels(std::vector<ThirdOctave> bands, Hertz bin_width, std::uint64_t interval)
    : bands_(std::move(bands)), bin_width_(bin_width), interval_(std::max<std::uint64_t>(interval, 1)), powers_(bands_.size()) {}

void BandLevels::take(std::span<const float> psd, std::uint64_t begin) {
  if (begin / interval_ != current_) finish();
  current_ = begin / interval_;
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    const double power = power_in(psd, bin_width_, bands_[b].low, bands_[b].high);
    if (std::isfinite(power)) powers_[b].push_back(static_cast<float>(power));
  }
}

void BandLevels::finish() {
  if (powers_.empty() || powers_.front().empty()) return;
  begins_.push_back(current_ * interval_);
  for (std::vector<float>& powers : powers_) {
    double sum = 0.0;
    for (const float power : powers) sum += static_cast<double>(power);
    mean_level_db_.push_back(level_of(sum / static_cast<double>(powers.size())));
    std::ranges::sort(powers);
  }
  for (const double percent : kPercentiles)
    for (const std::vector<float>& powers : powers_) percentile_level_db_.push_back(level_of(quantile(powers, percent)));
  for (std::vector<float>& powers : powers_) powers.clear();
}

}  // namespace earshot::spectrum
