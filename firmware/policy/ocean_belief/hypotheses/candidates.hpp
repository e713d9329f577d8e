#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/core/random.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis_block.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

inline constexpr std::size_t kRetainedHypotheses = config::kBeliefBlocks * kLanes;

/// The retained hypotheses, and how likely they are.
struct RetainedShares {
  std::array<Hypothesis, kRetainedHypotheses> hypotheses;
  std::array<float, kRetainedHypotheses> shares;  ///< they add up to one

  [[nodiscard]] bool holds(const Hypothesis& hypothesis) const;
  /// Share of all that drift.
  [[nodiscard]] float drifting() const;
};

/// Which others are weighed next.
enum class Trial : std::uint8_t {
  kAtRest,
  kMoving,   ///< whose sources move this way and that between two measurements
  kDrifting  ///< eight drifts of one hypothesis that is retained, or is like one: what is heard tells them from one another by their drift
             ///< alone
};

/// Draws what to try: drifts the more often the likelier those are that are retained; of the rest one in four that move.
[[nodiscard]] Trial draw_trial(const RetainedShares& retained, Pcg32& random);

/// Draws eight hypotheses that are not retained, half of the times from the prior, else like one that is retained and likely. Where there
/// are next to no others, one may be retained, or come twice.
[[nodiscard]] std::array<Hypothesis, kLanes> draw_candidates(const RetainedShares& retained, const OceanTables& tables, Trial trial,
                                                             Pcg32& random);

}  // namespace earshot::policy
