#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "firmware/core/units.hpp"

namespace earshot::listening {

/// The whole number by which a sample rate is divided for the detector: 1 up to the highest that it takes, else the smallest that brings
/// the rate there, one that leaves a whole number of hertz where such a one is less than twice as large.
[[nodiscard]] std::size_t decimation_for(Hertz sample_rate);

/// Sound at one sample rate, brought to a lower one.
///
///   y[m] = sum over k of h[k] x[m f - k],   h: sinc of half the lower rate under Kaiser's window, 2 K f + 1 taps, K = kReach
///
/// Flat up to 0.4 of the lower rate; what would fold into that is 100 dB down. y is K lower samples late: 0.2 to 0.4 ms.
/// Source: Oppenheim & Schafer, Discrete-Time Signal Processing, 7.6 (Kaiser's window).   Oracle: Decimator.*
class Decimator {
 public:
  /// K, which makes the filter's edge 0.2 of the lower rate wide.
  static constexpr std::size_t kReach = 17;

  /// @param full_scale  from there up a sample counts as clipped; then its lower sample is 1 or -1, and no other one gets there: so clipped
  /// sound is told from loud sound
  Decimator(std::size_t factor, float full_scale);

  /// The lower samples that these complete; valid until the next call.
  [[nodiscard]] std::span<const float> take(std::span<const float> samples);
  /// The next sample does not follow on. The sound before it counts as its like.
  void restart() { window_.clear(); }

  [[nodiscard]] std::size_t factor() const { return factor_; }

 private:
  std::size_t factor_;
  float full_scale_;
  std::vector<float> taps_;
  std::vector<float> window_;  ///< samples that the next lower ones are made of
  std::vector<float> lower_;
};

}  // namespace earshot::listening
