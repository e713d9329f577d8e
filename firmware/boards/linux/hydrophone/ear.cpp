#include "firmware/boards/linux/hydrophone/ear.hpp"

#include <cstddef>

namespace earshot::board {
namespace {

constexpr double kMicroseconds = 1e6;

messages::SoundDetection told(const detector::Detection& detection) {
  return {.begin = detection.begin,
          .duration = detection.duration,
          .level = detection.peak_level,
          .snr = detection.peak_snr,
          .is_clipped = detection.worst != detector::Hearing::kHears};
}

/// Of a block that may say anything.
double duration_us(const messages::HydrophoneBlock& block) {
  const bool is_rate = block.sample_rate >= messages::kLowestSampleRate && block.sample_rate <= messages::kHighestSampleRate;
  return is_rate ? kMicroseconds * static_cast<double>(block.samples_per_channel) / block.sample_rate.value : 0.0;
}

}  // namespace

Ear::Ear(const std::optional<detector::SoundSettings>& settings, WakesFor wakes) : settings_(settings), wakes_(wakes) {
  if (settings_ && detector_.configure(*settings_) != Status::kOk) settings_.reset();
}

void Ear::hear(const messages::HydrophoneBlock& block, std::span<const float> samples) {
  meter_.hear(block, samples);
  if (settings_) listen(block, samples);
  blocks_heard_.store(blocks_heard_.load(std::memory_order_relaxed) + 1, std::memory_order_release);  // after what it gave was put
  if (wakes_ == WakesFor::kBlocks) bell_.ring();
}

void Ear::listen(const messages::HydrophoneBlock& block, std::span<const float> samples) {
  constexpr double kNoRpm = 0.0;  // no message tells the thruster's
  detector_.note_motion(MetersPerSecond{speed_mps_.load(std::memory_order_relaxed)}, kNoRpm);
  detector_.hear(block, samples);
  while (const std::optional<detector::Estimate> estimate = detector_.next()) take(*estimate, block);
  tell_chain(block);
}

void Ear::take(const detector::Estimate& estimate, const messages::HydrophoneBlock& block) {
  const detector::ListeningPlan* const plan = detector_.plan();
  const bool is_of_block = plan == nullptr || estimate.hearing == detector::Hearing::kImpossible;  // there is one then, of all the block
  const double us = is_of_block ? duration_us(block) : kMicroseconds * static_cast<double>(plan->quarter) / plan->low_rate.value;
  sound_us_.at(static_cast<std::size_t>(estimate.hearing)).add(static_cast<std::uint64_t>(us));
  tell_deafness(estimate);
  bool is_put = true;
  if (estimate.ended) {
    detections_heard_.add(1);
    is_put = detections_.put(told(*estimate.ended));
    if (!is_put) left_out_.add(1);
  }
  if (estimate.is_look()) {
    looks_heard_.add(1);
    if (estimate.too_faint) looks_too_faint_.add(1);
    is_put = looks_.put(estimate.measurement());
    if (!is_put) left_out_.add(1);
    bell_.ring();
  }
}

void Ear::tell_chain(const messages::HydrophoneBlock& block) {
  const HeardChain chain = chain_of(block);
  if (has_told_ && chain == told_) return;
  if (!chains_.put(chain)) return;
  has_told_ = true;
  told_ = chain;
  bell_.ring();
}

void Ear::tell_deafness(const detector::Estimate& estimate) {
  const std::optional<bool> is_deaf = detector::is_deaf(estimate.hearing);
  if (!is_deaf || *is_deaf == is_told_deaf_ || !statuses_.put({.time = {}, .is_deaf = *is_deaf})) return;
  is_told_deaf_ = *is_deaf;
  bell_.ring();
}

HeardChain Ear::chain_of(const messages::HydrophoneBlock& block) const {
  HeardChain chain;
  chain.band = settings_->band;
  chain.sample_rate = block.sample_rate;
  chain.channels = block.channels;
  chain.fault = detector_.calibration_fault();
  const detector::ListeningPlan* const plan = detector_.plan();
  if (chain.fault != detector::CalibrationFault::kNone) {
    chain.heard = HeardChain::Heard::kImpossibleChain;
  } else if (plan == nullptr) {
    chain.heard = HeardChain::Heard::kRateTooLow;
  } else {
    chain.full_scale_level = detector::full_scale_level(settings_->calibration, block.gain);
    chain.adc_noise_level = detector::adc_noise_level(settings_->calibration, block.gain, block.sample_rate, settings_->band);
    chain.delay_s = plan->delay_s;
  }
  return chain;
}

Ear::Account Ear::heard() const {
  Account account{.looks = looks_heard_.value(),
                  .too_faint = looks_too_faint_.value(),
                  .detections = detections_heard_.value(),
                  .left_out = left_out_.value()};
  for (std::size_t i = 0; i < account.sound.size(); ++i) account.sound[i] = {static_cast<std::int64_t>(sound_us_[i].value())};
  return account;
}

}  // namespace earshot::board
