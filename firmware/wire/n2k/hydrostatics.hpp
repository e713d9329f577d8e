#pragma once

#include "firmware/core/units.hpp"

namespace earshot::n2k {

inline constexpr double kSeaWaterDensity_kg_per_m3 = 1025.0;
inline constexpr double kGravity_m_per_s2 = 9.80665;  ///< standard gravity

/// Depth under which the water alone (not the atmosphere) presses with `gauge_pressure_pa`.
///
///   z = p / (rho g),   rho = 1025 kg/m3 constant: at 300 m the sea's compressibility makes less than 0.1 % of it
/// Oracle: Hydrostatics.TenMetresOfSeaWaterPressWithOneBarAndABit
[[nodiscard]] constexpr Meters depth_of(double gauge_pressure_pa) {
  return Meters{gauge_pressure_pa / (kSeaWaterDensity_kg_per_m3 * kGravity_m_per_s2)};
}

/// The inverse, Pa.
[[nodiscard]] constexpr double gauge_pressure_pa_at(Meters depth) {
  return depth.value * kSeaWaterDensity_kg_per_m3 * kGravity_m_per_s2;
}

}  // namespace earshot::n2k
