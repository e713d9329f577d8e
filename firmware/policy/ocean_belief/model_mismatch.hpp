#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware/messages/health.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis.hpp"

namespace earshot::policy {

/// From this score on what was heard is not explained, bits. Were P a probability, what is drawn from it would ever come to it in at
/// most 2^-6.75 of all missions, 0.9 % (Ville's inequality). It is none: measurements are tempered, and prior penalties and priors left out
/// change its sum, on purpose. The measured share is what counts, README.md.
inline constexpr float kMismatchLevel_bits = messages::kMismatchThreshold_bits;

/// From this score on the vehicle sweeps the area. Chosen so that in no world measured it then finds less than by a sweep alone; of what
/// fits a little badly the belief finds most nevertheless: README.md.
inline constexpr float kSweepLevel_bits = 12.0F;

/// By how much less a hypothesis counts among the explanations of what is heard, log weight, at least 0. That a source is louder than every
/// table says, swims, or is heard with a spread of 7 dB explains nearly anything: such hypotheses let a belief survive what it does not
/// know. So each counts 2^-penalty of itself among the explanations. A source that drifts swims, too. Being fainter costs nothing: what is
/// too faint to measure fits every ocean. Oracle: PriorPenalty.*, UnlikelyExplanations.*
[[nodiscard]] int prior_penalty(const Hypothesis& hypothesis);

/// log2 of the sum of powers of two, all in 1/512. @param logs  at least one, at most 2^30 apart
/// Oracle: LogOfSum.*
[[nodiscard]] int log_of_sum(std::span<const int> logs);

/// How unlikely what was heard is under every hypothesis: by how much better it is explained by knowing nothing.
///
///   mismatch = log2 P0(heard) - log2 P(heard)
///   P  = sum over the retained hypotheses h:  2^-penalty(h) P(h but for its ocean and drift) P(heard | h)
///   P0 = mean over 9 levels m and 2 spreads s:  product over the measurements of  { 0.95 [0.98 N(SNR; m, s) + 0.02 / 80 dB] }^t, or of
///   0.05^t
///        where it was too faint, t what counts of a measurement in P as well (kTrust_256ths); no part of the mean falls under 1e-6 of all
///        of them, or what changes late would not be believed
///
/// m: 0, 5 ... 40 dB; s: 2 and 5 dB. P0 has the sound go on alike wherever the vehicle is, as in an ocean that carries it everywhere; a
/// bearing is one over 2 pi to it. Below 0 the oceans explain more than that.
/// Oracle: ModelMismatch.*
class ModelMismatch {
 public:
  /// Nothing has been heard, nothing is mismatched.
  void start();
  /// What a bearing says, which knowing nothing takes for one over 2 pi.
  /// @param likeliest  log2 in 1/512 of its likelihood times 2 pi where it is highest: that of which the weights of the places are shares
  void take_in_bearing(int likeliest) { bearings_ += likeliest; }
  /// A measurement.
  /// @param explained  log2 of P with this measurement, in 1/512, but for what take_in_bearing() was told
  void take_in(const Reception& reception, int explained);

  [[nodiscard]] float bits() const { return bits_; }
  /// True from the first measurement after which it came to kMismatchLevel_bits, until the next start().
  [[nodiscard]] bool is_mismatched() const { return is_mismatched_; }
  /// True from the first measurement after which it came to kSweepLevel_bits, until the next start().
  [[nodiscard]] bool calls_for_sweep() const { return calls_for_sweep_; }

 private:
  static constexpr std::size_t kLevels = 9;
  static constexpr std::size_t kSpreads = 2;

  void hear(const Reception& reception);

  /// Of the parts of P0; they add up to one. Without initial values: start() writes them, and zeros would take flash and time.
  std::array<std::array<float, kLevels>, kSpreads> weights_;
  int known_nothing_ = 0;  ///< log2 of P0, in 1/512
  int bearings_ = 0;
  float bits_ = 0.0F;
  bool is_mismatched_ = false;
  bool calls_for_sweep_ = false;
};

}  // namespace earshot::policy
