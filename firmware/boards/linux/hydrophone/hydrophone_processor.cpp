#include "firmware/boards/linux/hydrophone/hydrophone_processor.hpp"

#include <cstddef>

namespace earshot::board {
namespace {

constexpr double kMicroseconds = 1e6;

messages::SoundDetection message_of(const detector::Detection& detection) {
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

HydrophoneProcessor::HydrophoneProcessor(const std::optional<detector::SoundSettings>& settings, WakesFor wakes)
    : settings_(settings), wakes_(wakes) {
  if (settings_ && detector_.configure(*settings_) != Status::kOk) settings_.reset();
}

void HydrophoneProcessor::hear(const messages::HydrophoneBlock& block, std::span<const float> samples) {
  meter_.hear(block, samples);
  if (settings_) listen(block, samples);
  blocks_heard_.store(blocks_heard_.load(std::memory_order_relaxed) + 1, std::memory_order_release);  // after what it gave was put
  if (wakes_ == WakesFor::kBlocks) wake_event_.signal();
}

void HydrophoneProcessor::listen(const messages::HydrophoneBlock& block, std::span<const float> samples) {
  constexpr double kNoRpm = 0.0;  // no message tells the thruster's
  detector_.note_motion(MetersPerSecond{speed_mps_.load(std::memory_order_relaxed)}, kNoRpm);
  detector_.hear(block, samples);
  while (const std::optional<detector::Estimate> estimate = detector_.next()) take(*estimate, block);
  report_chain(block);
}

void HydrophoneProcessor::take(const detector::Estimate& estimate, const messages::HydrophoneBlock& block) {
  const detector::ListeningPlan* const plan = detector_.plan();
  const bool is_of_block = plan == nullptr || estimate.hearing == detector::Hearing::kImpossible;  // there is one then, of all the block
  const double us = is_of_block ? duration_us(block) : kMicroseconds * static_cast<double>(plan->quarter) / plan->low_rate.value;
  sound_us_.at(static_cast<std::size_t>(estimate.hearing)).add(static_cast<std::uint64_t>(us));
  report_deafness(estimate);
  bool is_put = true;
  if (estimate.ended) {
    detections_heard_.add(1);
    is_put = detections_.put(message_of(*estimate.ended));
    if (!is_put) left_out_.add(1);
  }
  if (estimate.is_snr_measurement()) {
    measurements_heard_.add(1);
    if (estimate.too_faint) measurements_too_faint_.add(1);
    is_put = measurements_.put(estimate.measurement());
    if (!is_put) left_out_.add(1);
    wake_event_.signal();
  }
}

void HydrophoneProcessor::report_chain(const messages::HydrophoneBlock& block) {
  const HeardChain chain = chain_of(block);
  if (has_reported_ && chain == reported_chain_) return;
  if (!chains_.put(chain)) return;
  has_reported_ = true;
  reported_chain_ = chain;
  wake_event_.signal();
}

void HydrophoneProcessor::report_deafness(const detector::Estimate& estimate) {
  const std::optional<bool> is_deaf = detector::is_deaf(estimate.hearing);
  if (!is_deaf || *is_deaf == is_reported_deaf_ || !statuses_.put({.time = {}, .is_deaf = *is_deaf})) return;
  is_reported_deaf_ = *is_deaf;
  wake_event_.signal();
}

HeardChain HydrophoneProcessor::chain_of(const messages::HydrophoneBlock& block) const {
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

HydrophoneProcessor::Account HydrophoneProcessor::heard() const {
  Account account{.measurements = measurements_heard_.value(),
                  .too_faint = measurements_too_faint_.value(),
                  .detections = detections_heard_.value(),
                  .left_out = left_out_.value()};
  for (std::size_t i = 0; i < account.sound.size(); ++i) account.sound[i] = {static_cast<std::int64_t>(sound_us_[i].value())};
  return account;
}

}  // namespace earshot::board
