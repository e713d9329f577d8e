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

inline constexpr std::size_t kHeldHypotheses = config::kBeliefBlocks * kLanes;

/// The hypotheses that are held, and how likely they are.
struct HeldHypotheses {
  std::array<Hypothesis, kHeldHypotheses> hypotheses;
  std::array<float, kHeldHypotheses> shares;  ///< they add up to one

  [[nodiscard]] bool holds(const Hypothesis& hypothesis) const;
  /// Share of all that drift.
  [[nodiscard]] float drifting() const;
};

/// Which others are weighed next.
enum class Trial : std::uint8_t {
  kAtRest,
  kMoving,   ///< whose sources move this way and that between two measurements
  kDrifting  ///< eight drifts of one hypothesis that is held, or is like one: what is heard tells them from one another by their drift
             ///< alone
};

/// Draws what to try: drifts the more often the likelier those are that are held; of the rest one in four that move.
[[nodiscard]] Trial draw_trial(const HeldHypotheses& held, Pcg32& random);

/// Draws eight hypotheses that are not held, half of the times from the prior, else like one that is held and likely. Where there are next
/// to no others, one may be held, or come twice.
[[nodiscard]] std::array<Hypothesis, kLanes> draw_candidates(const HeldHypotheses& held, const OceanTables& tables, Trial trial,
                                                             Pcg32& random);

}  // namespace earshot::policy
