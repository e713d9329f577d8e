#include "firmware/detector/hydrophone/sound_channel.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "firmware/core/math.hpp"

// Sums and products below are each rounded by themselves: this file is built with -ffp-contract=off.
namespace earshot::detector {
namespace {

/// No converter gives a sample this far beyond its full scale, 18 dB: it is no sample, and squared it would drown the floor for minutes.
constexpr float kMostSample = 8.0F;

/// Adds the squares one after the other, so that it does not matter in what pieces they come.
void add_squares(std::span<const float> samples, float& sum) {
  for (const float x : samples) sum = sum + x * x;
}

struct Extremes {
  float lowest = 0.0F;
  float highest = 0.0F;
  bool are_numbers = true;  ///< all of them; otherwise the extremes mean nothing
};

using Float4 [[gnu::vector_size(16)]] = float;

Extremes extremes_of(std::span<const float> samples) {
  Float4 lowest = Float4{} + samples[0];
  Float4 highest = lowest;
  Float4 zeros{};  // stays zero unless a sample is infinite or no number, whose product with zero is no number
  std::size_t i = 0;
  for (; i + 4 <= samples.size(); i += 4) {
    Float4 x;
    __builtin_memcpy(&x, samples.data() + i, sizeof x);
    lowest = x < lowest ? x : lowest;
    highest = x > highest ? x : highest;
    zeros += x * 0.0F;
  }
  Extremes extremes{.lowest = std::min(std::min(lowest[0], lowest[1]), std::min(lowest[2], lowest[3])),
                    .highest = std::max(std::max(highest[0], highest[1]), std::max(highest[2], highest[3]))};
  float zero = (zeros[0] + zeros[1]) + (zeros[2] + zeros[3]);
  for (; i < samples.size(); ++i) {
    extremes.lowest = std::min(extremes.lowest, samples[i]);
    extremes.highest = std::max(extremes.highest, samples[i]);
    zero = zero + samples[i] * 0.0F;
  }
  extremes.are_numbers = is_finite(zero);
  return extremes;
}

/// Flow noise falls with frequency, by more than this over the octaves under the band, in power per hertz: 6 dB.
constexpr double kFlowSlope = 4.0;

}  // namespace

void SoundChannel::configure(const ListeningPlan& plan) {
  floor_.configure(plan.floor_memory, plan.degrees_of_freedom);
  begin();
}

void SoundChannel::begin() {
  first_.clear();
  second_.clear();
  band_.clear();
  below_.clear();
  above_.clear();
  now_ = {};
  last_ = {};
  account_ = {};
  has_reference_ = false;
  learning_.reset();
}

void SoundChannel::feed(const ListeningPlan& plan, const ChainLevels& levels, const float* samples, std::size_t stride, std::size_t count) {
  while (count > 0) {
    const std::size_t go = std::min(count, config::kSoundChunk);
    take_in(levels, samples, stride, go, first_.room(plan.first));
    const std::size_t at_first_rate = first_.take(plan.first, go, second_.room(plan.second));
    add_powers(plan, second_.take(plan.second, at_first_rate, low_.data()));
    samples += go * stride;
    count -= go;
  }
}

void SoundChannel::take_in(const ChainLevels& levels, const float* samples, std::size_t stride, std::size_t count, float* room) {
  for (std::size_t i = 0; i < count; ++i) room[i] = samples[i * stride];
  const std::span<float> taken(room, count);
  Extremes extremes = extremes_of(taken);
  if (!extremes.are_numbers || extremes.highest > kMostSample || extremes.lowest < -kMostSample) {
    account_.has_nan = true;
    for (float& x : taken) good_ = x = is_finite(x) && x <= kMostSample && x >= -kMostSample ? x : good_;
    extremes = extremes_of(taken);
  }
  if (extremes.highest >= levels.clip || extremes.lowest <= -levels.clip) {
    account_.at_full_scale += static_cast<std::size_t>(
        std::count_if(taken.begin(), taken.end(), [clip = levels.clip](float x) { return x >= clip || x <= -clip; }));
  }
  account_.lowest = account_.samples == 0 ? extremes.lowest : std::min(account_.lowest, extremes.lowest);
  account_.highest = account_.samples == 0 ? extremes.highest : std::max(account_.highest, extremes.highest);
  account_.samples += count;
  if (!has_reference_) reference_ = taken[0];
  has_reference_ = true;
  good_ = taken[count - 1];
  for (float& x : taken) x = x - reference_;
}

void SoundChannel::add_powers(const ListeningPlan& plan, std::size_t count) {
  const std::span<float> low = std::span(low_).first(count);
  const std::span<float> filtered = std::span(filtered_).first(count);
  const auto add = [&](BandPass& filter, const BandPassDesign& design, float& sum) {
    std::copy(low.begin(), low.end(), filtered.begin());
    filter.run(design, filtered);
    add_squares(filtered, sum);
  };
  add(band_, plan.band, now_.band);
  if (plan.has_below) add(below_, plan.below, now_.below);
  if (plan.has_above) add(above_, plan.above, now_.above);
}

Hearing SoundChannel::hearing_of_samples() const {
  if (account_.has_nan) return Hearing::kNotANumber;
  if (2 * account_.at_full_scale >= account_.samples) return Hearing::kSaturated;
  if (account_.lowest == account_.highest) return Hearing::kStuck;
  return account_.at_full_scale > 0 ? Hearing::kClipped : Hearing::kHears;
}

void SoundChannel::end_quarter(const ListeningPlan& plan) {
  const auto count = static_cast<float>(plan.quarter);
  now_.band = now_.band / count;
  now_.below = now_.below / count;
  now_.above = now_.above / count;
  now_.hearing = hearing_of_samples();
  std::copy_backward(last_.begin(), last_.end() - 1, last_.end());
  last_[0] = now_;
  now_ = {};
  account_ = {};
}

double SoundChannel::noise_power(const ListeningPlan& plan, const ChainLevels& levels) const {
  double band = 0.0;
  double below = 0.0;
  double above = 0.0;
  for (std::size_t i = kQuarters; i-- > 0;) {
    band = band + double{last_[i].band};
    below = below + double{last_[i].below};
    above = above + double{last_[i].above};
  }
  const double scale = levels.full_scale_power / static_cast<double>(kQuarters);
  if (!plan.has_above) return band * scale;
  if (!(below > 0.0) || !(above > 0.0)) return 0.0;
  const double log_density =
      plan.flank_weight * log(below / plan.below_width_hz) + (1.0 - plan.flank_weight) * log(above / plan.above_width_hz);
  return exp(log_density) * plan.band_width_hz * scale;
}

bool SoundChannel::is_flow_noise(const ListeningPlan& plan, const ChainLevels& levels) const {
  if (!plan.has_below || !(floor_.power() > levels.flow_power)) return false;
  double band = 0.0;
  double below = 0.0;
  for (std::size_t i = 0; i < kQuarters; ++i) {
    band = band + double{last_[i].band};
    below = below + double{last_[i].below};
  }
  return below / plan.below_width_hz > kFlowSlope * (band / plan.band_width_hz);
}

ChannelPowers SoundChannel::powers(const ListeningPlan& plan, const ChainLevels& levels, std::size_t floor_needed) const {
  ChannelPowers powers{.hearing = Hearing::kHears, .noise = floor_.power()};
  for (std::size_t i = 0; i < kQuarters; ++i) {
    powers.quarters[i] = double{last_[kQuarters - 1 - i].band} * levels.full_scale_power;
    powers.power = powers.power + powers.quarters[i] / static_cast<double>(kQuarters);
  }
  for (const Quarter& quarter : last_) powers.hearing = std::max(powers.hearing, quarter.hearing);
  if (powers.power <= levels.open_power) powers.hearing = std::max(powers.hearing, Hearing::kOpen);
  if (is_flow_noise(plan, levels)) powers.hearing = std::max(powers.hearing, Hearing::kFlowNoise);
  const bool knows_noise = floor_.known() >= floor_needed && floor_.power() > 0.0;
  if (!knows_noise && powers.hearing <= Hearing::kClipped) powers.hearing = Hearing::kFloorUnsettled;
  return powers;
}

/// A call that ends in one integration time and began in the one before is held against neither: what is learnt lags by one.
void SoundChannel::learn(const ListeningPlan& plan, const ChainLevels& levels, Hearing hearing) {
  if (learning_) floor_.take(*learning_);
  learning_.reset();
  if (hearing > Hearing::kFlowNoise) return;
  const auto noise = static_cast<float>(noise_power(plan, levels));
  if (is_finite(noise)) learning_ = noise;
}

}  // namespace earshot::detector
