#pragma once

#include <vector>

#include "sim/ocean/environment.hpp"

namespace earshot::pe {

/// The sediment at one depth below the sea floor.
struct SedimentPoint {
  double depth_below_floor_m;
  double sound_speed_mps;
  double density_g_per_cm3;
  double attenuation_db_per_wavelength;
};

/// Layers from the sea floor down, the last a half-space: linear between the points, two points of equal depth make an interface, the
/// half-space below the last.
[[nodiscard]] std::vector<SedimentPoint> sediment_points(const std::vector<ocean::SedimentLayer>& layers);

}  // namespace earshot::pe
