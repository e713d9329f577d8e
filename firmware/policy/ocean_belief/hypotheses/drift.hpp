#pragma once

#include <cstdint>

#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/policy/belief/belief_model.hpp"

namespace earshot::policy {

/// Parts of a step length in which a drift is counted.
inline constexpr int kDriftParts = 16;

/// How far the source gets from one measurement to the next as navigation sees it, always the same way.
struct Drift {
  std::int8_t north = 0;  ///< in 1 / kDriftParts of a step length
  std::int8_t east = 0;
  /// A current that navigation does not see carries the vehicle: the whole area drifts with the source, and the vehicle may be over its
  /// edge where navigation sees none. Else the source swims and turns back at the area's edges.
  bool is_current = false;
  friend constexpr bool operator==(const Drift&, const Drift&) = default;
  [[nodiscard]] constexpr bool is_none() const { return north == 0 && east == 0; }
};

/// The fastest that are believed possible, in 1 / kDriftParts of a step length between two measurements: of a vehicle of 2 m/s that takes a
/// measurement at every step 0.75 m/s and 1.75 m/s.
inline constexpr int kMostCurrent = 6;
inline constexpr int kMostSwum = 14;

/// log2 of the prior probability, in 1/512.
[[nodiscard]] int log_prior(const Drift& drift);

/// Draws a drift: a current or a source that swims, either as often, any velocity as often as another.
[[nodiscard]] Drift draw_drift(Pcg32& random);

/// Draws one nearly as fast in nearly the same direction, now and then of the other kind.
[[nodiscard]] Drift draw_neighbour(const Drift& parent, Pcg32& random);

/// How far it has got after so many measurements.
[[nodiscard]] NorthEast way_of(const Drift& drift, const BeliefModel& model, std::uint32_t measurements);

}  // namespace earshot::policy
