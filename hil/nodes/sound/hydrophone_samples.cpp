#include "hil/nodes/sound/hydrophone_samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace earshot::hil {
namespace {

double amplitude(Decibels level) {
  return std::pow(10.0, level.value / 20.0);
}

double sine(Hertz frequency, std::int64_t sample) {
  return std::sin(2.0 * std::numbers::pi * frequency.value * static_cast<double>(sample) / HydrophoneSamples::kSampleRate.value);
}

}  // namespace

HydrophoneSamples::HydrophoneSamples(Decibels snr, std::uint64_t seed)
    : tone_(std::numbers::sqrt2 * amplitude(kNoise + snr)),
      noise_(amplitude(kNoise) * std::sqrt(kSampleRate.value / 2.0 / kBandWidth.value)),
      normal_(Pcg32(seed)) {
  block_.sample_rate = kSampleRate;
  block_.samples_per_channel = kSamples;
  block_.channels = 1;
  block_.sequence = -1;
}

bool HydrophoneSamples::take(Time end) {
  const double steps = std::ldexp(1.0, kBits - 1);
  block_.time = {end.us - kBlock.us};
  block_.first_sample = next_sample_;
  block_.overflow_count = 0;
  for (float& sample : samples_) {
    const double counts = std::nearbyint(next() * steps);
    const double clipped = std::clamp(counts, -steps, steps - 1.0);
    if (clipped != counts) ++block_.overflow_count;
    sample = static_cast<float>(clipped / steps);
    ++next_sample_;
  }
  if (!fault_.is_mute) ++block_.sequence;
  return !fault_.is_mute;
}

/// Before the ADC.
double HydrophoneSamples::next() {
  const double sea = tone_ * sine(kSource, next_sample_) + noise_ * normal_.next();
  switch (fault_.line) {
    case SoundLine::kWhole:
      return amplitude(fault_.gain_error) * sea;
    case SoundLine::kOpen:
      return kHum * sine(kMains, next_sample_);
    case SoundLine::kShorted:
      break;
  }
  return 0.0;
}

}  // namespace earshot::hil
