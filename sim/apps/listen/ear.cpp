#include "sim/apps/listen/ear.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace earshot::listen {

using detector::Hearing;

Ear::Ear(const detector::SoundSettings& settings, Hertz sample_rate)
    : settings_(settings), sample_rate_(sample_rate), detector_(std::make_unique<detector::SoundDetector>()) {
  if (detector_->configure(settings) != Status::kOk) throw std::invalid_argument(detector::to_string(detector::check(settings)));
}

void Ear::give(const recording::Piece& piece) {
  if (!piece.follows_on && piece.begin > 0) ++skipped_samples_;
  const auto first = static_cast<std::int64_t>(piece.begin);
  const messages::HydrophoneBlock block{
      .time = Time{static_cast<std::int64_t>(std::llround(static_cast<double>(first) / sample_rate_.value * 1e6))},
      .sequence = sequence_++,
      .first_sample = first + skipped_samples_,
      .sample_rate = sample_rate_,
      .gain = Decibels{0.0},
      .samples_per_channel = static_cast<std::uint32_t>(piece.samples.size()),
      .overflow_count = 0,
      .channels = 1};
  detector_->hear(block, piece.samples);
}

void Ear::learn_noise(const recording::Piece& piece) {
  is_learning_ = true;
  give(piece);
  while (detector_->next()) {
  }
}

void Ear::hear(const recording::Piece& piece) {
  if (is_learning_) {
    detector_->begin_again_knowing_the_noise();
    is_learning_ = false;
    skipped_samples_ = 0;
  }
  give(piece);
  while (const std::optional<detector::Estimate> estimate = detector_->next()) {
    ++estimates_[static_cast<std::size_t>(estimate->hearing)];
    const bool is_told = estimate->is_measured() || estimate->hearing == Hearing::kClipped;
    if (is_told && std::isfinite(estimate->floor.value)) {
      floor_sum_db_ += estimate->floor.value;
      ++floors_;
    }
    if (estimate->ended) detections_.push_back(*estimate->ended);
  }
}

void Ear::finish() {
  if (const std::optional<detector::Detection> last = detector_->finish()) detections_.push_back(*last);
}

Duration Ear::time_of(Hearing hearing) const {
  const detector::ListeningPlan* plan = detector_->plan();
  if (plan == nullptr) return {};
  const double quarter_s = static_cast<double>(plan->quarter) / plan->low_rate.value;
  return {std::llround(static_cast<double>(estimates_[static_cast<std::size_t>(hearing)]) * quarter_s * 1e6)};
}

Duration Ear::listened() const {
  return time_of(Hearing::kHears) + time_of(Hearing::kClipped);
}

Hearing Ear::main_obstacle() const {
  const auto worst = std::max_element(estimates_.begin() + 1, estimates_.end());
  return *worst == 0 ? Hearing::kHears : static_cast<Hearing>(worst - estimates_.begin());
}

Decibels Ear::mean_floor() const {
  return Decibels{floors_ == 0 ? std::numeric_limits<double>::quiet_NaN() : floor_sum_db_ / static_cast<double>(floors_)};
}

}  // namespace earshot::listen
