#include "sim/hydrophone/ambient_noise.hpp"

#include <cmath>
#include <numbers>

namespace earshot::hydrophone {
namespace {

constexpr double kPi = std::numbers::pi;

double feedback_of(Hertz corner, Hertz sample_rate) {
  return std::exp(-2.0 * kPi * (corner / sample_rate));
}

}  // namespace

double share_in_band(ocean::Band band, Hertz corner, Hertz sample_rate) {
  const double a = feedback_of(corner, sample_rate);
  const double k = (1.0 + a) / (1.0 - a);
  const auto below = [&](Hertz f) { return std::atan(k * std::tan(kPi * (f / sample_rate))); };
  return 2.0 / kPi * (below(band.high) - below(band.low));
}

AmbientNoise::AmbientNoise(Decibels band_level, ocean::Band band, Hertz sample_rate, Pcg32 random)
    : normal_(random), feedback_(feedback_of(kNoiseCorner, sample_rate)) {
  const double variance = std::pow(10.0, band_level.value / 10.0) / share_in_band(band, kNoiseCorner, sample_rate);
  gain_ = std::sqrt(variance * (1.0 - feedback_ * feedback_));
  last_ = std::sqrt(variance) * normal_.next();  // as if it had gone on forever
}

}  // namespace earshot::hydrophone
