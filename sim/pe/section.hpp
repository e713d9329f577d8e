#pragma once

#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"

namespace earshot::pe {

struct FloorPoint {
  double range_m;
  double depth_m;
};

/// The water at one range.
struct WaterColumn {
  double range_m;
  ocean::SoundSpeedProfile profile;
};

/// The sediment at one depth below the sea floor.
struct SedimentPoint {
  double depth_below_floor_m;
  double sound_speed_mps;
  double density_g_per_cm3;
  double attenuation_db_per_wavelength;
};

/// The sediment from one range on: linear between its points, two points of equal depth make an interface, a half-space below the last.
struct SedimentColumn {
  double range_m;
  std::vector<SedimentPoint> points;
};

/// A vertical cut through the ocean from the source outward. Bathymetry and water are linear in range between their points and constant
/// beyond the last; a sediment column holds until the next begins. The sediment's layers follow the sea floor.
struct Section {
  std::vector<FloorPoint> floor;
  std::vector<WaterColumn> water;
  std::vector<SedimentColumn> sediment;
  double water_attenuation_db_per_km = 0.0;

  [[nodiscard]] double floor_depth_m(double range_m) const;
  [[nodiscard]] const SedimentColumn& sediment_at(double range_m) const;
  [[nodiscard]] double water_sound_speed_mps(double range_m, double depth_m) const;
  [[nodiscard]] bool water_varies() const { return water.size() > 1; }
};

/// The same ocean in every direction and at every range; ocean_section.hpp makes a section of one that changes.
/// Throws std::invalid_argument when the environment changes with range or bearing.
[[nodiscard]] Section make_section(const ocean::Environment& environment);

/// Layers from the sea floor down, the last a half-space.
[[nodiscard]] std::vector<SedimentPoint> sediment_points(const std::vector<ocean::SedimentLayer>& layers);

/// Everything that the solver needs to be true of a section and a source in it.
///
/// Throws std::invalid_argument that names the quantity, its value and what is allowed: ranges that do not start at 0 or do not increase, a
/// sea floor above the surface (at the surface it may lie: a shore), sound speed, density or attenuation out of range or not finite, a
/// source not in the water. Oracle: Section.Refuses*
void require_valid(const Section& section, Meters source_depth);

}  // namespace earshot::pe
