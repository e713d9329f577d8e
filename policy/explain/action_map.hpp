#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::explain {

/// The action that a policy would take at one place.
struct MapPoint {
  NorthEast place;  ///< relative to the area's south-west corner
  std::vector<double> probabilities;
  std::size_t likeliest = 0;
  UnitNorthEast heading;   ///< of the mean of the directions weighted by their probabilities; of the likeliest when that mean is zero
  double agreement = 0.0;  ///< length of that mean: 1 when all probability lies on one direction, 0 when directions cancel out
};

/// [per_side x per_side] points from south to north, each row from west to east: the centres of equal cells of the policy's area.
using ActionMap = std::vector<MapPoint>;

/// The centres of per_side x per_side equal cells of an area, in the order of an ActionMap, relative to its south-west corner.
[[nodiscard]] std::vector<NorthEast> cell_centres(NorthEast area_size, std::size_t per_side);

/// The policy's actions after a first measurement at each place.
/// @param reception_at  what is heard there
/// Oracle: ActionMap.*
[[nodiscard]] ActionMap after_a_first_measurement(const policy::FrozenPolicy& policy, const policy::OceanTables& tables,
                                                  std::size_t per_side, const std::function<policy::Reception(NorthEast)>& reception_at);

/// The policy's actions if, with all that it remembers and believes, the vehicle stood elsewhere and had not found the source there.
/// @param memory  of the policy's own observation model
[[nodiscard]] ActionMap standing_elsewhere(const policy::FrozenPolicy& policy, const policy::OceanTables& tables, std::size_t per_side,
                                           const policy::SearchMemory& memory);

}  // namespace earshot::explain
