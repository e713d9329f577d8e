#pragma once

#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include "firmware/core/units.hpp"

namespace earshot::sonar {

/// SNR of one source at one receiver depth against horizontal range: a table with a uniform range step, looked up in constant time without
/// allocating.
///
/// Sample i stands at range i * range_step. Between samples the SNR in dB is linear in range. A range beyond either end of the table gets
/// the SNR at that end; a NaN range gets the first sample. Oracle: SnrCurve.IsLinearInDecibelsBetweenItsSamples,
/// SnrCurve.HoldsItsLastSampleBeyondItsEnd
class SnrCurve {
 public:
  /// @param range_step  > 0
  /// @param snr_db      at least one sample, all finite
  SnrCurve(Meters range_step, std::vector<float> snr_db) : samples_per_meter_(1.0 / range_step.value), snr_db_(std::move(snr_db)) {
    assert(range_step.value > 0.0 && !snr_db_.empty());
  }

  [[nodiscard]] Decibels at(Meters range) const {
    const double position = range.value * samples_per_meter_;
    if (!(position > 0.0)) return Decibels{static_cast<double>(snr_db_.front())};
    if (position >= static_cast<double>(snr_db_.size() - 1)) return Decibels{static_cast<double>(snr_db_.back())};
    const auto index = static_cast<std::size_t>(position);
    const double fraction = position - static_cast<double>(index);
    const double left = static_cast<double>(snr_db_[index]);
    const double right = static_cast<double>(snr_db_[index + 1]);
    return Decibels{left + fraction * (right - left)};
  }

  [[nodiscard]] Meters range_step() const { return Meters{1.0 / samples_per_meter_}; }
  [[nodiscard]] Meters max_range() const { return Meters{static_cast<double>(snr_db_.size() - 1) / samples_per_meter_}; }
  [[nodiscard]] const std::vector<float>& samples_db() const { return snr_db_; }

 private:
  double samples_per_meter_;
  std::vector<float> snr_db_;
};

}  // namespace earshot::sonar
