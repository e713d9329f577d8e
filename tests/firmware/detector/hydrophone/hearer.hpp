#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "tests/support/gaussian_noise.hpp"

namespace earshot::detector {

/// A detector that is given sound as a driver would give it, and keeps what it says.
class Hearer {
 public:
  Hearer(const SoundSettings& settings, double rate, std::uint8_t channels = 1) : status(detector->configure(settings)) {
    block.sample_rate = Hertz{rate};
    block.channels = channels;
  }

  /// @param samples  interleaved; piece  samples of one channel in a block
  void hear(std::span<const float> samples, std::size_t piece = 1000) {
    const std::size_t channels = block.channels;
    for (std::size_t i = 0; i < samples.size() / channels; i += piece) {
      const std::size_t count = std::min(piece, samples.size() / channels - i);
      block.samples_per_channel = static_cast<std::uint32_t>(count);
      block.time.us = static_cast<std::int64_t>(1e6 * static_cast<double>(block.first_sample) / block.sample_rate.value);
      hear_block(samples.subspan(i * channels, count * channels));
      block.first_sample += static_cast<std::int64_t>(count);
      ++block.sequence;
    }
  }

  /// As `block` says.
  void hear_block(std::span<const float> samples) {
    detector->hear(block, samples);
    while (const std::optional<Estimate> estimate = detector->next()) {
      if (estimate->ended) detections.push_back(*estimate->ended);
      estimates.push_back(*estimate);
    }
  }

  void finish() {
    if (const std::optional<Detection> last = detector->finish()) detections.push_back(*last);
  }

  /// As a recording is heard whose beginning was heard before.
  void hear_twice(std::span<const float> samples, double rate, const SoundSettings& settings) {
    const auto first = static_cast<std::size_t>(settings.floor_window.to_seconds() * rate);
    hear(samples.first(std::min(first, samples.size())));
    detector->begin_again_knowing_the_noise();
    estimates.clear();
    detections.clear();
    block.first_sample = 0;
    hear(samples);
    finish();
  }

  std::unique_ptr<SoundDetector> detector = std::make_unique<SoundDetector>();
  messages::HydrophoneBlock block;
  std::vector<Estimate> estimates;
  std::vector<Detection> detections;
  Status status;
};

/// White noise of a standard deviation, in shares of full scale.
inline std::vector<float> white_noise(double seconds, double rate, double deviation, std::uint64_t seed) {
  support::GaussianNoise noise(seed);
  std::vector<float> samples(static_cast<std::size_t>(seconds * rate));
  for (float& x : samples) x = static_cast<float>(deviation) * noise();
  return samples;
}

/// Adds a tone from `begin_s` on. @param amplitude  shares of full scale
inline void add_tone(std::vector<float>& samples, double rate, double frequency, double amplitude, double begin_s, double duration_s) {
  const auto first = static_cast<std::size_t>(begin_s * rate);
  const auto end = std::min(samples.size(), static_cast<std::size_t>((begin_s + duration_s) * rate));
  for (std::size_t i = first; i < end; ++i)
    samples[i] += static_cast<float>(amplitude * std::sin(2.0 * M_PI * frequency * static_cast<double>(i) / rate));
}

}  // namespace earshot::detector
