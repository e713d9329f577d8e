#pragma once

#include <limits>
#include <numbers>

namespace earshot::messages {

/// What a number of an input may be. False for a NaN.
struct Range {
  double lowest = 0.0;
  double highest = 0.0;
  [[nodiscard]] constexpr bool contains(double value) const { return value >= lowest && value <= highest; }
};

// The physical range of every number that any input brings: what is beyond it is no measurement, and nobody counts with it.

inline constexpr Range kPlace_m{-2e6, 2e6};            ///< north or east; a mission's own places lie within 1e6
inline constexpr Range kDepth_m{-100.0, 12'000.0};     ///< the sea's deepest, and what a pressure sensor that nobody zeroed may say in air
inline constexpr Range kHeading_rad{-1000.0, 1000.0};  ///< also of a gyrocompass that counts its turns
inline constexpr Range kSpeed_mps{-50.0, 50.0};        ///< through the water; astern is negative
inline constexpr Range kAltitude_m{-10.0, 12'000.0};   ///< above the sea floor
inline constexpr Range kBattery_percent{-1.0, 110.0};  ///< a gauge may round, and count more than its maker did
/// Either side of zero, whether heard or modelled: a source of 0 to 300 dB, a transmission loss of up to 300 dB and noise of -100 to 300 dB
/// are the most that an ocean's file may hold. A measurement beyond it would drag a window's mean along with it.
inline constexpr Range kSnr_db{-600.0, 600.0};
inline constexpr Range kDirection_rad{0.0, 2.0 * std::numbers::pi};  ///< of a bearing, or of the axis that it is mirrored at
inline constexpr Range kDeviation_rad{std::numeric_limits<double>::denorm_min(), std::numbers::pi};  ///< of a bearing: more than none
// Of an operator's limits: more than zero, and no more than the mission's (authority::tighten).

}  // namespace earshot::messages
