#pragma once

#include <bit>
#include <cstdint>

namespace earshot::policy {

// Probabilities as whole numbers: their logarithm to base 2 in units of 1/512. Sixteen bits hold 128 powers of two, a product is a sum of
// integers, and every machine has the same bits.

/// Units in a factor of two. One unit is 0.14 %; a hundred looks, each rounded, are 0.4 % off in the mean square.
inline constexpr int kOctave = 512;

/// 2^(weight / 512).
/// Error: at most 8e-5 of it.   @param weight  at least -60 000 and at most 60 000   Oracle: LogWeight.*
[[nodiscard]] inline float from_log(int weight) {
  const float f = static_cast<float>(weight & (kOctave - 1)) * (1.0F / static_cast<float>(kOctave));
  // A cubic that is as far from 2^f as it must be nowhere in [0, 1): 7.5e-5 of it.
  const float mantissa = 0.99992522F + f * (0.695833553F + f * (0.226067081F + f * 0.0780245902F));
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(mantissa) + (static_cast<std::uint32_t>(weight >> 9) << 23U));
}

/// 512 log2(x), rounded.
/// Error: at most 0.55 units.   @param x  > 0, no smaller than the least normal float, finite   Oracle: LogWeight.*
[[nodiscard]] inline int to_log(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const int exponent = static_cast<int>(bits >> 23U) - 127;
  const float m = std::bit_cast<float>((bits & 0x007FFFFFU) | 0x3F800000U) - 1.0F;
  // A quartic that is at most 8.8e-5 from log2(1 + m) in [0, 1).
  const float log = 8.75882851e-05F + m * (1.43770441F + m * (-0.674942915F + m * (0.318679073F + m * -0.0816157464F)));
  return exponent * kOctave + static_cast<int>(log * static_cast<float>(kOctave) + 0.5F);
}

}  // namespace earshot::policy
