#include "sim/hydrophone/calls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "firmware/core/math.hpp"

namespace earshot::hydrophone {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kSweepFrom = 23.0 / 20.0;
constexpr double kSweepTo = 18.0 / 20.0;
const double kPulseScale = 4.0 / std::sqrt(3.0);

double cosine_of_turns(double turns) {
  return sine_cosine(Radians{kTurn * (turns - std::round(turns))}).cosine;
}

/// In [0, period).
double within(double time_s, double period_s) {
  return time_s - period_s * std::floor(time_s / period_s);
}

double pulse(double time_s, Hertz frequency) {
  const double swell = sine_cosine(Radians{0.5 * kTurn * time_s / kPulse_s}).sine;
  const double falls_hz_per_s = (kSweepFrom - kSweepTo) * frequency.value / kPulse_s;
  return kPulseScale * swell * swell * cosine_of_turns((kSweepFrom * frequency.value - 0.5 * falls_hz_per_s * time_s) * time_s);
}

}  // namespace

double Tone::at(double time_s) const {
  return std::numbers::sqrt2 * cosine_of_turns(frequency.value * time_s);
}

double Song::at(double time_s) const {
  const double in_cycle_s = within(time_s, pattern.song_s + pattern.pause_s);
  const double last_call = std::ceil(pattern.song_s / pattern.interval_s) - 1.0;  // of a song, counted from 0
  const double latest = std::min(std::floor(in_cycle_s / pattern.interval_s), last_call);
  const double since_s = in_cycle_s - latest * pattern.interval_s;
  return since_s < kPulse_s ? pulse(since_s, frequency) : 0.0;
}

double Recording::at(double time_s) const {
  const auto size = static_cast<double>(samples.size());
  const double place = within(time_s * sample_rate.value, size);
  const auto at = static_cast<std::int64_t>(place);
  const double u = place - static_cast<double>(at);
  const auto sample = [this](std::int64_t i) {
    const auto count = static_cast<std::int64_t>(samples.size());
    return static_cast<double>(samples[static_cast<std::size_t>((i + count) % count)]);
  };
  const double p0 = sample(at - 1);
  const double p1 = sample(at);
  const double p2 = sample(at + 1);
  const double p3 = sample(at + 2);
  return p1 + 0.5 * u * (p2 - p0 + u * (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3 + u * (3.0 * (p1 - p2) + p3 - p0)));
}

}  // namespace earshot::hydrophone
