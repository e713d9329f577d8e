#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace earshot::tests {

inline std::vector<float> tone(double amplitude, double frequency_hz, double rate_hz, std::size_t samples) {
  std::vector<float> sound(samples);
  for (std::size_t i = 0; i < samples; ++i)
    sound[i] = static_cast<float>(amplitude * std::sin(2.0 * std::numbers::pi * frequency_hz * static_cast<double>(i) / rate_hz));
  return sound;
}

}  // namespace earshot::tests
