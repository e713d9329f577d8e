#pragma once

#include <cstddef>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"

namespace earshot::search {

using ActionTable = FixedVector<UnitNorthEast, config::kMaxActions>;

/// `count` compass directions (1 to config::kMaxActions), clockwise, action 0 north. Cardinal directions are exact.
[[nodiscard]] ActionTable compass_directions(std::size_t count);

}  // namespace earshot::search
