#pragma once

#include "firmware/core/math.hpp"
#include "firmware/core/units.hpp"

namespace earshot {

// Levels of powers, by the core's own logarithm: the same bits everywhere.

/// 10 lg(power); -infinity of zero, NaN of less.   Oracle: LevelOf.IsTenTimesTheDecimalLogarithm
[[nodiscard]] inline Decibels level_of(double power) {
  constexpr double kTenOverLn10 = 0x1.15f2ced384f28p+2;  // 4.3429448190325175
  return Decibels{kTenOverLn10 * log(power)};
}

/// The power of a level: 10^(level / 10).   Oracle: PowerOf.UndoesLevelOf
[[nodiscard]] inline double power_of(Decibels level) {
  constexpr double kLn10OverTen = 0x1.d791c5f888823p-3;  // 0.23025850929940458
  return exp(level.value * kLn10OverTen);
}

}  // namespace earshot
