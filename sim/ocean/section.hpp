#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/water/sound_speed.hpp"

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
/// Sound speed and sea floor are linear in range between stations and constant beyond the last. The sediment is a station's from its range
/// to the next one's, in steps; its layers follow the sea floor. A propagation model needs the first station of each at range 0.
struct Section {
  std::vector<WaterStation> water;         ///< at least one, range strictly increasing
  std::vector<SeaFloorStation> sea_floor;  ///< at least one, range strictly increasing
  std::vector<SedimentStation> sediment;   ///< at least one, range strictly increasing
  double absorption_db_per_km = 0.0;       ///< of the water, >= 0
  std::optional<Meters> shore = {};        ///< where the radial meets land and the section ends, if it does
  /// Where most water lies below the measurements, if at any station the sea floor is deeper than they are by more than a tenth: levels
  /// of an atlas lie that far apart.
  std::optional<UnmeasuredWater> unmeasured = {};
};

/// @param depth  positive down
/// Oracle: RadialSection.IsLinearInRangeBetweenItsStations
[[nodiscard]] MetersPerSecond sound_speed(const Section& section, Meters range, Meters depth);

/// @return positive down; 0 on the shore
[[nodiscard]] Meters sea_floor_depth(const Section& section, Meters range);

/// The station whose sediment is there: the last that begins at or before the range, or the first.
[[nodiscard]] const SedimentStation& sediment_at(const Section& section, Meters range);

}  // namespace earshot::ocean
