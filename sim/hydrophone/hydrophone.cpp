#include "sim/hydrophone/hydrophone.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace earshot::hydrophone {
namespace {

// Streams of the flight's seed. The start draws from 0, the conditions from 1.
constexpr std::uint64_t kNoiseStream = 2;
constexpr std::uint64_t kLossStream = 3;

double amplitude(Decibels level) {
  return std::pow(10.0, level.value / 20.0);
}

double power(Decibels level) {
  return std::pow(10.0, level.value / 10.0);
}

}  // namespace

Decibels SelfNoise::level(MetersPerSecond speed) const {
  constexpr MetersPerSecond kReference{2.0};
  return at_two_mps + Decibels{60.0 * std::log10(std::abs(speed.value) / kReference.value)};
}

Hydrophone::Hydrophone(HydrophoneSettings settings, std::uint64_t seed)
    : settings_(std::move(settings)),
      noise_(settings_.noise_level, settings_.band, settings_.sample_rate, Pcg32(seed, kNoiseStream)),
      losses_(seed, kLossStream) {
  assert(settings_.adc_bits >= 2 && settings_.adc_bits <= 24);
  const auto count = static_cast<std::size_t>(std::llround(settings_.sample_rate.value * settings_.block.to_seconds()));
  pressure_.resize(count);
  samples_.resize(count);
  block_.sample_rate = settings_.sample_rate;
  block_.gain = settings_.gain;
  block_.samples_per_channel = static_cast<std::uint32_t>(count);
  block_.channels = 1;
  block_.sequence = -1;
}

bool Hydrophone::hear(const Situation& now, Time end) {
  assert(now.arrivals.size() == last_.arrivals.size());
  block_.time = {end.us - settings_.block.us};
  block_.first_sample = next_sample_;
  next_sample_ += static_cast<std::int64_t>(samples_.size());
  add_noise(last_, now);
  const double begin_s = (block_.time - Time{}).to_seconds();
  for (std::size_t i = 0; i < now.arrivals.size(); ++i) add_call(last_.arrivals[i], now.arrivals[i], begin_s);
  quantise();
  last_ = now;
  if (losses_.uniform_double() < settings_.loss) return false;
  ++block_.sequence;
  return true;
}

void Hydrophone::add_noise(const Situation& before, const Situation& now) {
  const auto over_sea = [this](const Situation& s) {
    return std::sqrt(1.0 + power(settings_.self_noise.level(s.speed) - settings_.noise_level));
  };
  const double first = over_sea(before);
  const double rise = (over_sea(now) - first) / static_cast<double>(pressure_.size());
  for (std::size_t i = 0; i < pressure_.size(); ++i) pressure_[i] = (first + rise * static_cast<double>(i)) * noise_.next();
}

void Hydrophone::add_call(const Arrival& before, const Arrival& now, double begin_s) {
  const auto count = static_cast<double>(pressure_.size());
  const double factor = amplitude((now.level - before.level) / count);
  const double delay_s = before.range.value / settings_.sound_speed.value;
  const double delay_growth_s = (now.range - before.range).value / settings_.sound_speed.value / count;
  const double step_s = 1.0 / settings_.sample_rate.value - delay_growth_s;
  const double sent_s = begin_s - delay_s + before.sung_s;
  const auto add = [&](const auto& calls) {
    double scale = amplitude(before.level);
    for (std::size_t i = 0; i < pressure_.size(); ++i) {
      pressure_[i] += scale * calls.at(sent_s + static_cast<double>(i) * step_s);
      scale *= factor;
    }
  };
  std::visit(add, settings_.calls);
}

void Hydrophone::quantise() {
  const double steps = std::ldexp(1.0, settings_.adc_bits - 1);
  const double steps_per_upa = steps / amplitude(settings_.full_scale);
  block_.overflow_count = 0;
  for (std::size_t i = 0; i < pressure_.size(); ++i) {
    const double counts = std::nearbyint(pressure_[i] * steps_per_upa);
    const double clipped = std::clamp(counts, -steps, steps - 1.0);
    if (clipped != counts) ++block_.overflow_count;
    samples_[i] = static_cast<float>(clipped / steps);
  }
}

}  // namespace earshot::hydrophone
