#include "firmware/detector/hydrophone/detection_tracker.hpp"

#include <algorithm>
#include <cstddef>

#include "firmware/core/decibels.hpp"
#include "firmware/detector/hydrophone/chi_square.hpp"

namespace earshot::detector {

namespace {

constexpr double kWithin = 10.0;  ///< of the loudest: 10 dB
constexpr double kRise = 1.26;    ///< a louder quarter counts as a rise from 1 dB on
constexpr double kAlways = 2.0;   ///< of the loudest: 3 dB

constexpr double kAsLoudAsNoise = 1.0;                 ///< an SNR of 0 dB
constexpr double kOneOfAHundred = 2.3263478740408408;  ///< the normal distribution's quantile of 0.99

}  // namespace

double Extent::limit(double loudest) const {
  return std::max(loudest / kWithin, std::min(noise_, loudest / kAlways));
}

void Extent::take(Time end, double power) {
  if (power > loudest_) loudest_ = power;
  if (size_ == 0 || power > kRise * rises_[size_ - 1].power) {
    std::size_t gone = 0;
    while (gone < size_ && rises_[gone].power < limit(power)) ++gone;
    for (std::size_t i = gone; i < size_; ++i) rises_[i - gone] = rises_[i];
    size_ -= gone;
    rises_[size_++] = {.end = end, .power = power};
  }
  if (power >= limit(loudest_)) end_ = end;
}

void DetectionTracker::configure(const SoundSettings& settings) {
  threshold_ = settings.detection_threshold;
  m_of_n_ = settings.m_of_n;
  longest_pause_ = settings.longest_pause;
  clear();
}

void DetectionTracker::clear() {
  reached_ = 0;
  detection_.reset();
  is_enough_ = false;
  extent_.clear();
  last_held_ = {};
}

void DetectionTracker::set_quarter(Duration quarter, double degrees_of_freedom) {
  quarter_ = quarter;
  extent_ = Extent(chi_square_over_mean(degrees_of_freedom / static_cast<double>(kQuarters), kOneOfAHundred));
  clear();
}

/// Whether a detection goes on with such an estimate, of P / N.
bool DetectionTracker::is_held(double ratio) const {
  const double held = std::max(power_of(threshold_ - kHysteresis), kAsLoudAsNoise);
  return ratio - 1.0 >= std::min(held, power_of(threshold_));
}

/// Whether m of the last n reached the threshold, this one among them.
bool DetectionTracker::is_enough(bool reaches) {
  reached_ = (reached_ << 1U) | (reaches ? 1U : 0U);
  std::uint32_t count = 0;  // not std::popcount, which a baseline processor has in a library only
  for (std::uint32_t i = 0; i < m_of_n_.n; ++i) count += reached_ >> i & 1U;
  return reaches && count >= m_of_n_.m;
}

std::optional<Detection> DetectionTracker::take(const Estimate& estimate, const std::array<double, kQuarters>& quarter_ratios) {
  std::optional<Detection> ended;
  if (detection_ && estimate.time - last_held_ > longest_pause_ + quarter_) {
    ended = finish();
  }
  const bool is_measured = estimate.hearing == Hearing::kHears || estimate.hearing == Hearing::kClipped;
  double ratio = 0.0;
  for (const double quarter_ratio : quarter_ratios) ratio = ratio + quarter_ratio / static_cast<double>(kQuarters);
  is_enough_ = is_enough(estimate.reaches_threshold) || (detection_ && is_enough_);
  if (detection_) {
    extent_.take(estimate.time, quarter_ratios.back());
  } else if (estimate.reaches_threshold) {
    detection_.emplace();
    for (std::size_t i = 0; i < kQuarters; ++i)
      extent_.take({estimate.time.us - static_cast<std::int64_t>(kQuarters - 1 - i) * quarter_.us}, quarter_ratios[i]);
  }
  if (estimate.reaches_threshold) extend(estimate);
  if (detection_ && is_measured && is_held(ratio)) last_held_ = estimate.time;
  return ended;
}

void DetectionTracker::extend(const Estimate& estimate) {
  const bool is_loudest = detection_->estimates == 0 || estimate.snr > detection_->peak_snr;
  ++detection_->estimates;
  detection_->worst = std::max(detection_->worst, estimate.hearing);
  if (!is_loudest) return;
  detection_->peak_snr = estimate.snr;
  detection_->peak_level = estimate.level;
  detection_->peak = estimate.time;
}

std::optional<Detection> DetectionTracker::finish() {
  std::optional<Detection> ended = is_enough_ ? detection_ : std::nullopt;
  if (ended) {
    ended->begin = extent_.begin(quarter_);
    ended->duration = extent_.end() - ended->begin;
  }
  detection_.reset();
  extent_.clear();
  is_enough_ = false;
  return ended;
}

}  // namespace earshot::detector
