#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace earshot::policy {

// Probabilities as whole numbers: their logarithm to base 2 in units of 1/512. Sixteen bits hold 128 powers of two, a product is a sum of
// integers, and every machine has the same bits.

/// Units in a factor of two. One unit is 0.14 %; a hundred measurements, each rounded, are 0.4 % off in the mean square.
inline constexpr int kOctave = 512;

/// Coefficients of a cubic that is as far from 2^f as it must be nowhere in [0, 1): 7.5e-5 of it; that of f^0 first.
inline constexpr std::array<float, 4> kPowerOfTwo{0.99992522F, 0.695833553F, 0.226067081F, 0.0780245902F};

/// That cubic, of what of a weight is less than a factor of two. @param fraction  0 to 511
[[nodiscard]] consteval float power_of_fraction(std::size_t fraction) {
  const float f = static_cast<float>(fraction) * (1.0F / static_cast<float>(kOctave));
  return kPowerOfTwo[0] + f * (kPowerOfTwo[1] + f * (kPowerOfTwo[2] + f * kPowerOfTwo[3]));
}

/// Its bits for each, less what the fraction adds to the weight where that is shifted to the exponent: 4 instructions take the place of 13
/// on a Cortex-M7.
inline constexpr auto kPowerBits = []() consteval {
  std::array<std::uint32_t, kOctave> bits{};
  for (std::size_t i = 0; i < bits.size(); ++i)
    bits[i] = std::bit_cast<std::uint32_t>(power_of_fraction(i)) - static_cast<std::uint32_t>(i << 14U);
  return bits;
}
();

/// 2^(weight / 512).
/// Error: at most 8e-5 of it.   @param weight  at least -60 000 and at most 60 000   Oracle: LogWeight.*
[[nodiscard]] inline float from_log(int weight) {
  const auto bits = static_cast<std::uint32_t>(weight);
  return std::bit_cast<float>(kPowerBits[bits & (kOctave - 1)] + (bits << 14U));
}

/// 512 log2(x), rounded.
/// Error: at most 0.55 units.   @param x  > 0, no smaller than the least normal float, finite   Oracle: LogWeight.*
[[nodiscard]] int to_log(float x);

/// to_log() of every probability, but at least `least`, of a zero too, and at most 0.
/// @param logs  as many; the result
void to_logs(std::span<const float> probabilities, std::int16_t least, std::span<std::int16_t> logs);

}  // namespace earshot::policy
