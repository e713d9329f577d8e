#pragma once

#include <complex>
#include <cstddef>
#include <numbers>
#include <span>

#include "sim/ocean/band.hpp"

namespace earshot::hydrophone {

/// Mean power of a sound within a band, by the plain sum of Fourier's transform over pieces of ten seconds; what is left over at the end
/// does not count. Lines on the band's ends count half.
inline double power_in(ocean::Band band, std::span<const double> samples, Hertz rate) {
  constexpr double kPiece_s = 10.0;
  const auto piece = static_cast<std::size_t>(kPiece_s * rate.value);
  const auto first = static_cast<std::size_t>(band.low.value * kPiece_s);
  const auto last = static_cast<std::size_t>(band.high.value * kPiece_s);
  double power = 0.0;
  std::size_t pieces = 0;
  for (; (pieces + 1) * piece <= samples.size(); ++pieces) {
    for (std::size_t line = first; line <= last; ++line) {
      const double turn = -2.0 * std::numbers::pi * static_cast<double>(line) / static_cast<double>(piece);
      const std::complex<double> step = std::polar(1.0, turn);
      std::complex<double> sum;  // Horner's rule, from the last sample to the first
      for (std::size_t i = piece; i-- > 0;) sum = sum * step + samples[pieces * piece + i];
      power += (line == first || line == last ? 0.5 : 1.0) * 2.0 * std::norm(sum / static_cast<double>(piece));
    }
  }
  return power / static_cast<double>(pieces);
}

}  // namespace earshot::hydrophone
