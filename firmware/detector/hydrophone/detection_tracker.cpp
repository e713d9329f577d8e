#include "firmware/detector/hydrophone/detection_tracker.hpp"

#include <algorithm>
#include <cstddef>

#include "firmware/core/decibels.hpp"

namespace earshot::detector {

namespace {

constexpr double kWithin = 10.0;  ///< of the loudest: 10 dB
constexpr double kRise = 1.26;    ///< a louder quarter counts as a rise from 1 dB on

}  // namespace

void Extent::take(Time end, double power) {
  if (power > loudest_) loudest_ = power;
  if (size_ == 0 || power > kRise * rises_[size_ - 1].power) {
    std::size_t gone = 0;
    while (gone < size_ && kWithin * rises_[gone].power < power) ++gone;
    for (std::size_t i = gone; i < size_; ++i) rises_[i - gone] = rises_[i];
    size_ -= gone;
    rises_[size_++] = {.end = end, .power = power};
  }
  if (kWithin * power >= loudest_) end_ = end;
}

void DetectionTracker::configure(const SoundSettings& settings) {
  *this = DetectionTracker(settings.detection_threshold, settings.m_of_n, settings.longest_pause, quarter_);
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
  const bool is_told = estimate.hearing == Hearing::kHears || estimate.hearing == Hearing::kClipped;
  double ratio = 0.0;
  for (const double quarter_ratio : quarter_ratios) ratio = ratio + quarter_ratio / static_cast<double>(kQuarters);
  const bool is_held = is_told && ratio - 1.0 >= power_of(threshold_ - kHysteresis);
  is_enough_ = is_enough(estimate.reaches_threshold) || (detection_ && is_enough_);
  if (detection_) {
    extent_.take(estimate.time, quarter_ratios.back());
  } else if (estimate.reaches_threshold) {
    detection_.emplace();
    for (std::size_t i = 0; i < kQuarters; ++i)
      extent_.take({estimate.time.us - static_cast<std::int64_t>(kQuarters - 1 - i) * quarter_.us}, quarter_ratios[i]);
  }
  if (estimate.reaches_threshold) extend(estimate);
  if (detection_ && is_held) last_held_ = estimate.time;
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
