#include "sim/listening/channel_detector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace earshot::listening {

using detector::Hearing;

namespace {

constexpr Time kEndless{std::numeric_limits<std::int64_t>::max()};

}  // namespace

ChannelDetector::ChannelDetector(const detector::SoundSettings& settings, Hertz sample_rate)
    : settings_(settings), sample_rate_(sample_rate), detector_(std::make_unique<detector::SoundDetector>()) {
  const bool is_right = detector_->configure(settings) == Status::kOk && make_plan(settings, sample_rate, plan_) == Status::kOk;
  if (!is_right) throw std::invalid_argument(detector::to_string(detector::check(settings)));
}

std::size_t ChannelDetector::lead() const {
  return (plan_.settling_quarters + detector::kQuarters) * plan_.quarter * plan_.factor();
}

std::size_t ChannelDetector::tail() const {
  return static_cast<std::size_t>(std::ceil(plan_.delay_s * plan_.sample_rate.value)) + 1;
}

Time ChannelDetector::time_at(std::int64_t sample) const {
  return {std::llround(static_cast<double>(sample) / sample_rate_.value * 1e6)};
}

void ChannelDetector::give(std::span<const float> samples, std::int64_t first) {
  const messages::HydrophoneBlock block{.time = time_at(first),
                                        .sequence = sequence_++,
                                        .first_sample = first + static_cast<std::int64_t>(lead()) + skipped_samples_,
                                        .sample_rate = sample_rate_,
                                        .gain = Decibels{0.0},
                                        .samples_per_channel = static_cast<std::uint32_t>(samples.size()),
                                        .overflow_count = 0,
                                        .channels = 1};
  detector_->hear(block, samples);
}

/// What is heard up to the recording's end.
void ChannelDetector::draw(Time end) {
  while (const std::optional<detector::Estimate> estimate = detector_->next()) {
    if (estimate->time <= Time{}) {  // before the recording
      (void)detector_->finish();
      continue;
    }
    if (estimate->time > end) {  // after it
      if (estimate->ended) detections_.push_back(*estimate->ended);
      finish_detection();
      while (detector_->next()) (void)detector_->finish();
      (void)detector_->finish();
      return;
    }
    ++estimates_[static_cast<std::size_t>(estimate->hearing)];
    const bool is_known = estimate->is_measured() || estimate->hearing == Hearing::kClipped;
    if (is_known && std::isfinite(estimate->floor.value)) {
      floor_sum_db_ += estimate->floor.value;
      ++floors_;
    }
    if (estimate->ended) detections_.push_back(*estimate->ended);
  }
}

void ChannelDetector::prepare(std::span<const float> before) {
  give(before, -static_cast<std::int64_t>(before.size()));
  draw(Time{});
}

void ChannelDetector::learn_noise(const recording::Piece& piece) {
  if (!piece.follows_on && piece.begin > 0) ++skipped_samples_;
  give(piece.samples, static_cast<std::int64_t>(piece.begin));
  while (detector_->next()) {
  }
}

void ChannelDetector::begin_again() {
  detector_->begin_again_knowing_the_noise();
  skipped_samples_ = 0;
}

void ChannelDetector::hear(const recording::Piece& piece) {
  if (!piece.follows_on && piece.begin > 0) ++skipped_samples_;
  next_ = static_cast<std::int64_t>(piece.begin + piece.samples.size());
  give(piece.samples, static_cast<std::int64_t>(piece.begin));
  draw(kEndless);
}

void ChannelDetector::finish(std::span<const float> after) {
  if (!after.empty()) {
    give(after, next_);
    draw(time_at(next_));
  }
  finish_detection();
}

void ChannelDetector::finish_detection() {
  if (const std::optional<detector::Detection> last = detector_->finish()) detections_.push_back(*last);
}

Duration ChannelDetector::time_of(Hearing hearing) const {
  const detector::ListeningPlan* plan = detector_->plan();
  if (plan == nullptr) return {};
  const double quarter_s = static_cast<double>(plan->quarter) / plan->low_rate.value;
  return {std::llround(static_cast<double>(estimates_[static_cast<std::size_t>(hearing)]) * quarter_s * 1e6)};
}

Duration ChannelDetector::listened() const {
  // The first estimate's quarter begins before the recording does.
  return std::min(time_of(Hearing::kHears) + time_of(Hearing::kClipped), time_at(next_) - Time{});
}

Hearing ChannelDetector::main_obstacle() const {
  const auto worst = std::max_element(estimates_.begin() + 1, estimates_.end());
  return *worst == 0 ? Hearing::kHears : static_cast<Hearing>(worst - estimates_.begin());
}

Decibels ChannelDetector::mean_floor() const {
  return Decibels{floors_ == 0 ? std::numeric_limits<double>::quiet_NaN() : floor_sum_db_ / static_cast<double>(floors_)};
}

}  // namespace earshot::listening
