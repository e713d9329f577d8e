#include "firmware/detector/hydrophone/sound_detector.hpp"

#include <algorithm>
#include <limits>

#include "firmware/core/decibels.hpp"

// Sums and products below are each rounded by themselves: this file is built with -ffp-contract=off.
namespace earshot::detector {
namespace {

constexpr Decibels kUnknownLevel{std::numeric_limits<double>::quiet_NaN()};
/// Nothing but the ADC: a band that has no more than twice the power of the ADC's own noise.
constexpr double kOpenOverNoise = 2.0;
/// A floor so far above the ambient that is expected is something else's: 20 dB.
constexpr double kFlowOverExpected = 100.0;
/// Powers that a noise floor must know: a quarter of its memory, or this many where that is more.
constexpr std::size_t kFewestPowers = 8;
/// The same for a recording that was heard before.
constexpr std::size_t kFewestPowersKnown = 3;
/// Dates further from zero than this are nonsense: 36 000 years.
constexpr std::int64_t kFurthestDate_us = std::int64_t{1} << 60;
constexpr double kMicroseconds = 1e6;

Estimate nothing_heard(Time time) {
  Estimate estimate;
  estimate.time = time;
  estimate.hearing = Hearing::kImpossible;
  estimate.snr = estimate.level = estimate.floor = kUnknownLevel;
  return estimate;
}

ChainLevels levels_of(const SoundSettings& settings, const messages::HydrophoneBlock& block) {
  const Calibration& calibration = settings.calibration;
  const double steps = static_cast<double>(std::int64_t{1} << (calibration.adc_bits - 1));
  ChainLevels levels{.full_scale_power = power_of(full_scale_level(calibration, block.gain)),
                     .open_power = kOpenOverNoise * power_of(adc_noise_level(calibration, block.gain, block.sample_rate, settings.band)),
                     .flow_power = std::numeric_limits<double>::infinity(),
                     .clip = static_cast<float>(1.0 - 1.5 / steps)};
  if (is_finite(settings.expected_noise.value)) levels.flow_power = kFlowOverExpected * power_of(settings.expected_noise);
  return levels;
}

}  // namespace

Status SoundDetector::configure(const SoundSettings& settings) {
  is_configured_ = check(settings) == SettingsFault::kNone;
  settings_ = settings;
  has_plan_ = false;
  has_begun_ = false;
  knows_the_noise_ = false;
  is_too_loud_ = false;
  calibration_fault_ = CalibrationFault::kNone;
  samples_ = {};
  consumed_ = 0;
  block_ = {};
  is_impossible_ = false;
  tracker_.configure(settings);
  return is_configured_ ? Status::kOk : Status::kOutOfRange;
}

void SoundDetector::hear(const messages::HydrophoneBlock& block, std::span<const float> samples) {
  const Decibels gain_before = block_.gain;
  is_impossible_ = judge(block, samples) == Hearing::kImpossible;
  samples_ = is_impossible_ ? std::span<const float>{} : samples;
  consumed_ = 0;
  const messages::HydrophoneBlock before = block_;
  block_ = block;
  if (is_impossible_) {
    has_begun_ = false;
    return;
  }
  const bool is_same_chain = has_plan_ && plan_.sample_rate == block.sample_rate && before.channels == block.channels;
  if (!is_same_chain) plan_for(block);
  if (is_impossible_) return;
  levels_ = levels_of(settings_, block);
  if (!has_begun_ || !is_same_chain) {
    restart(Hearing::kFillingUp);
  } else if (block.first_sample != next_sample_) {
    restart(Hearing::kDropout);
  } else if (block.gain != gain_before) {
    restart(Hearing::kGainChanged);
  }
  has_begun_ = true;
  next_sample_ = block.first_sample;
}

Hearing SoundDetector::judge(const messages::HydrophoneBlock& block, std::span<const float> samples) {
  const bool is_whole = block.channels >= 1 && block.channels <= config::kHydrophoneChannels &&
                        samples.size() == std::size_t{block.samples_per_channel} * block.channels;
  const bool is_counted = block.first_sample >= 0 && block.first_sample <= messages::kLastSample;
  const bool is_dated = block.time.us >= -kFurthestDate_us && block.time.us <= kFurthestDate_us;
  const bool is_rate = block.sample_rate.value > 0.0 && block.sample_rate <= messages::kHighestSampleRate;
  calibration_fault_ = is_rate ? check(settings_.calibration, block.gain, block.sample_rate, settings_.band, settings_.expected_noise)
                               : CalibrationFault::kNone;
  const bool is_possible = is_configured_ && is_whole && is_counted && is_dated && is_rate && calibration_fault_ == CalibrationFault::kNone;
  return is_possible ? Hearing::kHears : Hearing::kImpossible;
}

/// Another rate or another number of channels is another sender: what was known of the noise goes.
void SoundDetector::plan_for(const messages::HydrophoneBlock& block) {
  has_plan_ = make_plan(settings_, block.sample_rate, plan_) == Status::kOk;
  is_impossible_ = !has_plan_;
  if (is_impossible_) {
    samples_ = {};
    return;
  }
  for (SoundChannel& channel : channels_) channel.configure(plan_);
  knows_the_noise_ = false;
  const double quarter_s = static_cast<double>(plan_.quarter) / plan_.low_rate.value;
  tracker_.set_quarter({static_cast<std::int64_t>(quarter_s * kMicroseconds)}, plan_.degrees_of_freedom);
}

void SoundDetector::restart(Hearing reason) {
  for (SoundChannel& channel : channels_) channel.begin();
  fed_ = 0;
  quarters_ = 0;
  began_with_ = reason;
}

std::optional<Estimate> SoundDetector::next() {
  if (is_impossible_) {
    is_impossible_ = false;
    return nothing_heard(block_.time);
  }
  const std::size_t stride = block_.channels;
  const std::size_t in_quarter = plan_.quarter * plan_.factor();
  while (consumed_ < samples_.size() / std::max<std::size_t>(stride, 1)) {
    const std::size_t count = std::min(in_quarter - fed_, samples_.size() / stride - consumed_);
    for (std::size_t c = 0; c < stride; ++c) {
      if (is_listened_to(c)) channels_[c].feed(plan_, levels_, &samples_[consumed_ * stride + c], stride, count);
    }
    consumed_ += count;
    fed_ += count;
    next_sample_ += static_cast<std::int64_t>(count);
    if (fed_ == in_quarter) return end_quarter();
  }
  samples_ = {};
  return std::nullopt;
}

Time SoundDetector::time_of(std::size_t consumed) const {
  const double since_s = static_cast<double>(consumed) / plan_.sample_rate.value - plan_.delay_s;
  return {block_.time.us + static_cast<std::int64_t>(since_s * kMicroseconds)};
}

Estimate SoundDetector::end_quarter() {
  fed_ = 0;
  ++quarters_;
  Estimate estimate = nothing_heard(time_of(consumed_));
  const bool is_full = quarters_ >= plan_.settling_quarters + kQuarters;
  estimate.is_independent = is_full && (quarters_ - plan_.settling_quarters) % kQuarters == 0;
  estimate.channel_count = block_.channels;
  const std::size_t floor_needed = knows_the_noise_ ? kFewestPowersKnown : std::max(plan_.floor_memory / 4, kFewestPowers);
  AllPowers powers;
  for (std::size_t c = 0; c < block_.channels; ++c) {
    if (!is_listened_to(c)) continue;
    channels_[c].end_quarter(plan_);
    powers[c] = channels_[c].powers(plan_, levels_, floor_needed);
    if (is_too_loud_) powers[c].hearing = std::max(powers[c].hearing, Hearing::kSelfNoise);
    // What is clipped while the filters fill up is no sound to detect: their own beginning is in it.
    if (!is_full && powers[c].hearing <= Hearing::kClipped) powers[c].hearing = began_with_;
    if (estimate.is_independent) channels_[c].learn(plan_, levels_, powers[c].hearing);
    estimate.channels[c] = {.hearing = powers[c].hearing, .level = level_of(powers[c].power), .floor = level_of(powers[c].noise)};
    estimate.hearing = std::min(estimate.hearing, powers[c].hearing);
  }
  std::array<double, kQuarters> quarter_ratios{};
  if (estimate.hearing == Hearing::kHears || estimate.hearing == Hearing::kClipped) quarter_ratios = estimate_snr(powers, estimate);
  estimate.ended = tracker_.take(estimate, quarter_ratios);
  return estimate;
}

/// The mean over the channels that hear best. @return P / N of the four quarters
std::array<double, kQuarters> SoundDetector::estimate_snr(const AllPowers& powers, Estimate& estimate) const {
  double power = 0.0;
  double noise = 0.0;
  double ratio = 0.0;
  double count = 0.0;
  std::array<double, kQuarters> quarter_ratios{};
  for (std::size_t c = 0; c < block_.channels; ++c) {
    if (!is_listened_to(c) || powers[c].hearing != estimate.hearing) continue;
    power = power + powers[c].power;
    noise = noise + powers[c].noise;
    ratio = ratio + powers[c].power / powers[c].noise;
    for (std::size_t i = 0; i < kQuarters; ++i) quarter_ratios[i] = quarter_ratios[i] + powers[c].quarters[i] / powers[c].noise;
    count = count + 1.0;
  }
  for (double& quarter_ratio : quarter_ratios) quarter_ratio = quarter_ratio / count;
  ratio = ratio / count;
  estimate.level = level_of(power / count);
  estimate.floor = level_of(noise / count);
  estimate.too_faint = !(ratio >= plan_.least_ratio);
  estimate.snr = level_of(std::max(ratio, plan_.least_ratio) - 1.0);
  estimate.reaches_threshold = !estimate.too_faint && estimate.snr >= settings_.detection_threshold;
  return quarter_ratios;
}

bool SoundDetector::is_listened_to(std::size_t channel) const {
  return (settings_.channels >> channel & 1U) != 0;
}

std::optional<Detection> SoundDetector::finish() {
  return tracker_.finish();
}

void SoundDetector::begin_again_knowing_the_noise() {
  knows_the_noise_ = has_plan_;
  has_begun_ = false;
  samples_ = {};
  is_impossible_ = false;
  tracker_.clear();
}

void SoundDetector::note_motion(MetersPerSecond speed, double thruster_rpm) {
  is_too_loud_ = speed > settings_.gate.speed || thruster_rpm > settings_.gate.thruster_rpm;
}

}  // namespace earshot::detector
