#pragma once

#include <cmath>

#include "sim/ocean/environment.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::sonar {

/// Spherical spreading, until the parabolic equation is merged.
inline SnrCurve compute_snr_curve(const ocean::Environment& environment, Meters, Meters max_range) {
  std::vector<float> snr;
  for (double r = 0; r <= max_range.value; r += 10.0) {
    snr.push_back(static_cast<float>((environment.source.level - environment.noise_level).value - 20.0 * std::log10(std::max(r, 1.0)) - r * 0.0005));
  }
  return SnrCurve(Meters{10.0}, snr);
}

}  // namespace earshot::sonar
