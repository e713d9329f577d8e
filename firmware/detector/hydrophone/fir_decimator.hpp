#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/units.hpp"

namespace earshot::detector {

/// A low-pass with linear phase that keeps one sample of `factor`.
struct FirDesign {
  std::size_t factor = 1;                                  ///< 1: passes everything as it is, and has no taps
  std::size_t tap_count = 0;                               ///< padded with zeros at the oldest end to whole vectors
  double delay = 0.0;                                      ///< samples at its input
  alignas(32) std::array<float, config::kFirTaps> taps{};  ///< the oldest sample's first
  [[nodiscard]] std::span<const float> used() const { return std::span(taps).first(tap_count); }
};

/// A Kaiser window of 80 dB on a sinc: passes up to `pass` within 0.001 dB, and holds what would fold onto that 80 dB down.
/// @param pass  less than half the output's rate
/// @return the number of taps it needs; nothing is designed where that is more than config::kFirTaps
/// Source: Kaiser 1974; Oppenheim & Schafer, Discrete-Time Signal Processing, 3rd ed., eqs. 7.72-7.76.
/// Oracle: FirDesign.HasTheTapsThatScipyDesigns
std::size_t design_fir(Hertz input_rate, std::size_t factor, Hertz pass, FirDesign& design);

/// sum of taps[i] * samples[i], the order of additions fixed: sixteen sums side by side, then pairwise.
/// @param samples  as many as taps, a multiple of 16
[[nodiscard]] float dot(std::span<const float> taps, const float* samples);

/// The samples that a decimator still needs, for one channel. Begins with silence.
template <std::size_t kTaps>
class FirHistory {
 public:
  static constexpr std::size_t kChunk = config::kSoundChunk;

  void clear() {
    buffer_.fill(0.0F);
    phase_ = 0;
  }

  /// Room for up to kChunk more samples.
  [[nodiscard]] float* room(const FirDesign& design) { return buffer_.data() + design.tap_count; }

  /// What `count` samples written into the room make. @return how many were put into `out`
  std::size_t take(const FirDesign& design, std::size_t count, float* out) {
    if (design.factor == 1) {
      for (std::size_t i = 0; i < count; ++i) out[i] = buffer_[i];
      return count;
    }
    std::size_t made = 0;
    std::size_t next = design.factor - phase_;  // samples until the next output
    for (; next <= count; next += design.factor) out[made++] = dot(design.used(), buffer_.data() + next);
    phase_ = design.factor - (next - count);
    for (std::size_t i = 0; i < design.tap_count; ++i) buffer_[i] = buffer_[count + i];
    return made;
  }

 private:
  alignas(32) std::array<float, kTaps + kChunk> buffer_{};  ///< the last tap_count samples, then those that come
  std::size_t phase_ = 0;                                   ///< samples since the last output
};

}  // namespace earshot::detector
