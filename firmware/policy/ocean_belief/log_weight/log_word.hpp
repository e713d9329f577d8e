#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "firmware/policy/ocean_belief/log_weight/lanes.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

#if defined(__ARM_FEATURE_SIMD32) && !defined(__ARM_NEON)
#include <arm_acle.h>
#endif

namespace earshot::policy {

// A word is as many log weights as a register of the target holds: a loop over cells and hypotheses goes word by word, with the same bits
// everywhere. Eight with vectors (SSE2, AVX2, NEON); two with the DSP instructions of an Armv7E-M, which are written out here, for the
// compiler would take the lanes one by one.

#if defined(__ARM_FEATURE_SIMD32) && !defined(__ARM_NEON)

inline constexpr std::size_t kLanesInAWord = 2;

struct [[gnu::may_alias]] LogWord {
  std::uint32_t pair;  ///< the lower lane in the lower half
};
struct FloatWord {
  std::array<float, kLanesInAWord> lanes;
};

/// The first of the kWords words of some lanes; behind them come those of what lies behind in memory.
inline const LogWord* words_of(const LogLanes& lanes) {
  return reinterpret_cast<const LogWord*>(&lanes);
}
inline LogWord* words_of(LogLanes& lanes) {
  return reinterpret_cast<LogWord*>(&lanes);
}
/// So many words a loop over cells takes together: what they have in common is looked up once, and the registers hold no more.
inline constexpr std::size_t kWordsTogether = 2;

inline LogWord every_lane(std::int16_t value) {
  return {static_cast<std::uint16_t>(value) * 0x10001U};
}
inline LogWord operator+(LogWord a, LogWord b) {
  return {static_cast<std::uint32_t>(__sadd16(static_cast<int16x2_t>(a.pair), static_cast<int16x2_t>(b.pair)))};
}
inline LogWord operator-(LogWord a, LogWord b) {
  return {static_cast<std::uint32_t>(__ssub16(static_cast<int16x2_t>(a.pair), static_cast<int16x2_t>(b.pair)))};
}
/// a - b of each lane, but no less than sixteen bits hold. @param b  at least 0
inline LogWord minus_saturated(LogWord a, LogWord b) {
  return {static_cast<std::uint32_t>(__qsub16(static_cast<int16x2_t>(a.pair), static_cast<int16x2_t>(b.pair)))};
}
inline LogWord operator&(LogWord a, LogWord b) {
  return {a.pair & b.pair};
}
inline LogWord max(LogWord a, LogWord b) {
  static_cast<void>(__ssub16(static_cast<int16x2_t>(a.pair), static_cast<int16x2_t>(b.pair)));  // where a is no less the lane is marked
  return {__sel(a.pair, b.pair)};
}
/// from_log() of every lane: a multiplication of half a register shifts it and adds it at once.
inline void from_log(LogWord weights, FloatWord& probabilities) {
  const auto fraction_of = [](std::uint32_t weight) { return static_cast<std::int32_t>(kPowerBits[weight & (kOctave - 1)]); };
  const auto pair = static_cast<std::int32_t>(weights.pair);
  probabilities.lanes = {std::bit_cast<float>(__smlabb(pair, 1 << 14, fraction_of(weights.pair))),
                         std::bit_cast<float>(__smlatb(pair, 1 << 14, fraction_of(weights.pair >> 16U)))};
}
inline float lane_of(const FloatWord& word, std::size_t lane) {
  return word.lanes[lane];
}
inline void get(const FloatLanes& lanes, std::size_t word, FloatWord& value) {
  value.lanes = {lanes[kLanesInAWord * word], lanes[kLanesInAWord * word + 1]};
}
inline void operator+=(FloatWord& a, const FloatWord& b) {
  for (std::size_t l = 0; l < kLanesInAWord; ++l) a.lanes[l] += b.lanes[l];
}
inline void operator*=(FloatWord& a, const FloatWord& b) {
  for (std::size_t l = 0; l < kLanesInAWord; ++l) a.lanes[l] *= b.lanes[l];
}

#else

inline constexpr std::size_t kLanesInAWord = kLanes;

using LogWord = LogLanes;
using FloatWord = float __attribute__((vector_size(4 * kLanes)));

inline const LogWord* words_of(const LogLanes& lanes) {
  return &lanes;
}
inline LogWord* words_of(LogLanes& lanes) {
  return &lanes;
}
inline constexpr std::size_t kWordsTogether = 1;

inline LogWord every_lane(std::int16_t value) {
  return LogWord{} + value;
}
inline LogWord max(const LogWord& a, const LogWord& b) {
  return a > b ? a : b;
}
/// a - b of each lane, but no less than sixteen bits hold. @param b  at least 0
inline LogWord minus_saturated(const LogWord& a, const LogWord& b) {
  return max(a, b + std::numeric_limits<std::int16_t>::min()) - b;
}
/// from_log() of every lane.
inline void from_log(const LogWord& weights, FloatWord& probabilities) {
  using IntWord = std::int32_t __attribute__((vector_size(4 * kLanes)));
  const IntWord w = __builtin_convertvector(weights, IntWord);
  const FloatWord f = __builtin_convertvector(w & (kOctave - 1), FloatWord) * (1.0F / static_cast<float>(kOctave));
  const FloatWord mantissa = kPowerOfTwo[0] + f * (kPowerOfTwo[1] + f * (kPowerOfTwo[2] + f * kPowerOfTwo[3]));
  probabilities = reinterpret_cast<FloatWord>(reinterpret_cast<IntWord>(mantissa) + (w >> 9) * (1 << 23));
}
inline float lane_of(const FloatWord& word, std::size_t lane) {
  return word[lane];
}
inline void get(const FloatLanes& lanes, std::size_t /*word*/, FloatWord& value) {
  for (std::size_t l = 0; l < kLanes; ++l) value[l] = lanes[l];
}

#endif

inline constexpr std::size_t kWords = kLanes / kLanesInAWord;
static_assert(kWords % kWordsTogether == 0);
using LogWords = std::array<LogWord, kWordsTogether>;

/// Calls `visit` with the index of every word, or of so many.
template <std::size_t kCount = kWords, class Visit>
void for_each_word(Visit visit) {
  [&]<std::size_t... Word>(std::index_sequence<Word...>) {
    (visit(Word), ...);
  }
  (std::make_index_sequence<kCount>{});
}

}  // namespace earshot::policy
