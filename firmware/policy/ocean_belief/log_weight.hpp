#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace earshot::policy {

// Probabilities as whole numbers: their logarithm to base 2 in units of 1/512. Sixteen bits hold 128 powers of two, a product is a sum of
// integers, and every machine has the same bits.

/// Units in a factor of two. One unit is 0.14 %; a hundred looks, each rounded, are 0.4 % off in the mean square.
inline constexpr int kOctave = 512;

/// Coefficients of a cubic that is as far from 2^f as it must be nowhere in [0, 1): 7.5e-5 of it; that of f^0 first.
inline constexpr std::array<float, 4> kPowerOfTwo{0.99992522F, 0.695833553F, 0.226067081F, 0.0780245902F};

/// 2^(weight / 512).
/// Error: at most 8e-5 of it.   @param weight  at least -60 000 and at most 60 000   Oracle: LogWeight.*
[[nodiscard]] float from_log(int weight);

/// 512 log2(x), rounded.
/// Error: at most 0.55 units.   @param x  > 0, no smaller than the least normal float, finite   Oracle: LogWeight.*
[[nodiscard]] int to_log(float x);

/// to_log() of every probability, but at least `least`, of a zero too, and at most 0.
/// @param logs  as many; the result
void to_logs(std::span<const float> probabilities, std::int16_t least, std::span<std::int16_t> logs);

}  // namespace earshot::policy
