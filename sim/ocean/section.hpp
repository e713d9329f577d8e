#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/sound_speed.hpp"

namespace earshot::ocean {

/// Water below the deepest measurement, in which only pressure raises the sound speed.
struct UnmeasuredWater {
  std::string file;  ///< the climatology
  Meters range;
  Meters data_end;   ///< depth of the deepest measurement
  Meters sea_floor;  ///< there

  [[nodiscard]] Meters thickness() const { return sea_floor - data_end; }
};

/// "FILE: temperature and salinity end at 1500 m, ..."
[[nodiscard]] std::string to_string(const UnmeasuredWater& water);

/// The ocean in the vertical plane along one radial: what a propagation model marches through.
///
/// Sound speed and sea floor are linear in range between stations and constant beyond the first and the last. So are thickness, sound
/// speed, density and attenuation of each sediment layer; every station has the same number of layers, and they follow the sea floor.
struct Section {
  std::vector<WaterStation> water;         ///< at least one, range strictly increasing
  std::vector<SeaFloorStation> sea_floor;  ///< at least one, range strictly increasing
  std::vector<SedimentStation> sediment;   ///< at least one, range strictly increasing
  std::optional<Meters> shore;             ///< where the radial meets land and the section ends, if it does
  /// Where most water lies below the measurements, if at any station the sea floor is deeper than they are by more than a tenth: levels
  /// of an atlas lie that far apart.
  std::optional<UnmeasuredWater> unmeasured = {};
};

/// @param depth  positive down
/// Oracle: RadialSection.IsLinearInRangeBetweenItsStations
[[nodiscard]] MetersPerSecond sound_speed(const Section& section, Meters range, Meters depth);

/// @return positive down; 0 on the shore
[[nodiscard]] Meters sea_floor_depth(const Section& section, Meters range);

/// From the sea floor down.
[[nodiscard]] const std::vector<SedimentLayer>& sediment_layers(const Section& section, Meters range);

[[nodiscard]] bool is_range_independent(const Section& section);

/// Whether every section of the environment is alike and range-independent: `water` and `seabed` tell all of it.
[[nodiscard]] bool is_range_independent(const Environment& environment);

/// The radial of `bearing` from `from`, as far as `max_range` or the shore.
///
/// Range is true distance along a geodesic where the environment has a geographic origin; the bearing is that of the local plane, in which
/// the geodesic ends at `from` + `max_range` in this direction. Stations stand half a grid cell of the charts apart, which bilinear charts
/// lose nothing but the curvature inside a cell by. What the environment gives against range (not charts) starts anew at `from`.
///
/// @param bearing    clockwise from north
/// @param max_range  > 0
/// Throws host::BadInput where a chart has no data, or where `from` is on land.
/// Oracle: SectionAlong.*
[[nodiscard]] Section section_along(const Environment& environment, NorthEast from, Radians bearing, Meters max_range);

}  // namespace earshot::ocean
