#pragma once

#include <cassert>
#include <cstdint>

#include "firmware/core/random.hpp"

namespace earshot::search {

/// How many streams of a seed training has, and evaluation: PCG32 has 2^63.
inline constexpr std::uint64_t kStreams = 1ULL << 62U;

/// SplitMix64's output function: one to one, and half of the bits change with any bit of x.
/// Source: Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014; constants of Vigna's splitmix64.c.
/// Oracle: Streams.MixesAsTheReferenceDoes
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E37'79B9'7F4A'7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58'476D'1CE4'E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D0'49BB'1331'11EBULL;
  return x ^ (x >> 31U);
}

/// What a training draws from.
/// @param number  below kStreams: whose numbers of that seed they are
[[nodiscard]] constexpr Pcg32 training_random(std::uint64_t seed, std::uint64_t number) {
  assert(number < kStreams);
  return Pcg32(seed, number);
}

/// What an evaluation draws from: of no seed a stream that any training has, so that no search is judged that was learned from.
/// The seed is mixed besides: PCG32's state is linear in seed and stream, and with streams that differ in a high bit only, the low bits of
/// one state are those of the other, the numbers hardly more than rotated.
/// @param number  below kStreams
/// Oracle: Streams.OfEvaluationAreNoneOfTraining, Streams.OfEvaluationAreNotTrainingsNumbersInDisguise
[[nodiscard]] constexpr Pcg32 evaluation_random(std::uint64_t seed, std::uint64_t number) {
  assert(number < kStreams);
  return Pcg32(mixed(seed), kStreams + number);
}

}  // namespace earshot::search
