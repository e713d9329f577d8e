#pragma once

#include <array>

#include "firmware/core/geometry.hpp"

namespace earshot::bits {

inline constexpr double kDiagonal = 0.70710678118654757;  // sqrt(1/2)
/// North first, then clockwise by 45 degrees: of policies that are made for a test.
inline constexpr std::array<UnitNorthEast, 8> kEightDirections{{{1.0, 0.0},
                                                                {kDiagonal, kDiagonal},
                                                                {0.0, 1.0},
                                                                {-kDiagonal, kDiagonal},
                                                                {-1.0, 0.0},
                                                                {-kDiagonal, -kDiagonal},
                                                                {0.0, -1.0},
                                                                {kDiagonal, -kDiagonal}}};

}  // namespace earshot::bits
