#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/policy/belief/belief_model.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

/// From these on silence is long: a vehicle that hears nothing for so long sweeps the area until it hears something (README.md).
inline constexpr float kLongAgainstBelief_bits = 20.0F;
inline constexpr float kLongAgainstTables_bits = 8.0F;

/// How unlikely it is that nothing has been detected for so long: a source that is silent or far fainter than expected, a hydrophone that
/// is dead. To ModelMismatch that is no mismatch, for silence fits a fainter source. Since the last detection, or the start:
///
///   against the belief = sum over the measurements of  -log2(1 - P(detected)),   P by all that was heard before each measurement
///   against the tables = -log2 sum over the sources j of  w_j product over the silent measurements of (1 - (1 - q_j) P(SNR >= h)),
///     SNR ~ N(SNR_k(|s_j - x|) + m_j, (4 dB)^2);   the sum of w_j is one
///
/// A vehicle that is told an SNR of far too little believes in a source that is hard to hear, yet near: the first sees it go to and fro.
/// One that cannot measure anything drifts to beliefs that expect nothing; the second knows no belief. Its sources are drawn once for all:
/// place s_j uniform in the area, at rest, ocean k, level m_j and share of pauses q_j from the prior, but the rare as often as the
/// frequent, which the weights w_j make up for. A measurement is silent where nothing reaches h, 3 dB (the sound is twice the noise) or the
/// detection threshold if that is less, and where it is too faint to measure, h being what could have been measured if that is more. A
/// measurement in between, or with a bearing, is neither silence nor a detection, so that the second is a score and no probability
/// (README.md). Oracle: Silence.*
class Silence {
 public:
  static constexpr std::size_t kSources = config::kSilentSources;

  /// Nothing has been listened to.
  void start();
  /// A measurement; against the tables it counts with the next catch_up(), which is to come before the next measurement.
  /// @param position  from the area's south-west corner   @param expected  P(detected) before it, 0 to 1
  void take_in(const BeliefModel& model, NorthEast position, const Reception& reception, float expected);
  /// Whether the last measurement is not counted against the tables yet.
  [[nodiscard]] bool is_behind() const { return is_behind_; }
  /// Counts it.
  void catch_up(const BeliefModel& model, const OceanTables& tables);

  [[nodiscard]] float against_belief_bits() const { return in_bits(against_belief_); }
  [[nodiscard]] float against_tables_bits() const { return in_bits(against_tables_); }
  /// From the first measurement after which one of them came to its level, until something is detected or the next start().
  [[nodiscard]] bool is_long() const {
    return against_belief_bits() >= kLongAgainstBelief_bits || against_tables_bits() >= kLongAgainstTables_bits;
  }

 private:
  [[nodiscard]] static float in_bits(int log);

  /// -log2 of each product, in 1/16; no product is less than 2^-16. Without initial values: start() writes them, and zeros would take flash
  /// and time.
  std::array<std::uint8_t, kSources> unheard_;
  int against_belief_ = 0;  ///< in 1/512 bits, both
  int against_tables_ = 0;
  bool is_behind_ = false;
  NorthEast position_;  ///< of the measurement that is to be counted
  Decibels least_;      ///< nothing of that or louder was heard there
};

}  // namespace earshot::policy
