#pragma once

#include <cstddef>

#include "tests/firmware/policy/belief/belief_rig.hpp"

namespace earshot::policy {

inline constexpr Meters kRangeStep{100};

/// Of a cell of 500 m x 500 m.
inline NorthEast centre(std::size_t north, std::size_t east) {
  return at((static_cast<double>(north) + 0.5) * 500.0, (static_cast<double>(east) + 0.5) * 500.0);
}

}  // namespace earshot::policy
