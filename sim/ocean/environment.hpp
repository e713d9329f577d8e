#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "sim/ocean/water/sea_water.hpp"
#include "sim/ocean/water/sound_speed.hpp"

namespace earshot::ocean {

/// A fluid sediment, linear in depth from its top to its base; where nothing is given for the base, as at the top.
struct SedimentLayer {
  Meters thickness;                            ///< > 0; the last layer is a half-space and its thickness is not used
  MetersPerSecond sound_speed;                 ///< at the top, > 0
  double density_g_per_cm3 = 1.5;              ///< > 0; the water's is 1
  double attenuation_db_per_wavelength = 0.5;  ///< >= 0
  std::optional<MetersPerSecond> sound_speed_at_base = {};
  std::optional<double> density_at_base_g_per_cm3 = {};
  std::optional<double> attenuation_at_base_db_per_wavelength = {};
};

struct Seabed {
  Meters depth;                       ///< of the sea floor, > 0
  std::vector<SedimentLayer> layers;  ///< from the sea floor down, at least one
};

/// Sound speed against depth at a range from the source.
struct WaterStation {
  Meters range;
  SoundSpeedProfile profile;
};

struct SeaFloorStation {
  Meters range;
  Meters depth;  ///< positive down
};

struct SedimentStation {
  Meters range;
  std::vector<SedimentLayer> layers;  ///< from the sea floor down, at least one
};

/// Sea water that absorbs sound, as found at a depth.
struct AbsorbingWater {
  SeaWater water;
  Meters depth;
};

struct Charts;  ///< sea floor and water by geographic position; see charts.hpp

struct Source {
  Hertz frequency;     ///< > 0
  Decibels level;      ///< dB re 1 uPa @ 1 m
  Meters depth;        ///< in the water
  NorthEast position;  ///< in the plane of the search domain
};

/// One ocean and the source in it.
///
/// `water` and `seabed` are what is found at the source. An ocean that changes with place has stations, the same on every bearing, or
/// charts besides; `section_along` in section.hpp makes one radial out of whichever there are.
struct Environment {
  std::string name;
  SoundSpeedProfile water;
  Seabed seabed;
  Source source;
  Decibels noise_level;                                  ///< in the detector's band, dB re 1 uPa
  double absorption_db_per_km = 0.0;                     ///< of sea water at the source's frequency, >= 0
  std::vector<WaterStation> water_stations = {};         ///< empty: `water` at every range
  std::vector<SeaFloorStation> sea_floor_stations = {};  ///< empty: `seabed.depth` at every range
  std::vector<SedimentStation> sediment_stations = {};   ///< empty: `seabed.layers` at every range
  std::shared_ptr<const Charts> charts = {};             ///< null: none
  /// CRC-32 of the file this was read from and of all it names (data files, what was read of charts; of a scenario also its other oceans
  /// and its field library), for provenance; 0: none.
  std::uint32_t file_crc32 = 0;
  std::vector<std::filesystem::path> files = {};  ///< the same ones, itself first; empty: none
  std::optional<AbsorbingWater> absorbing = {};   ///< what `absorption_db_per_km` was computed of; empty: nothing absorbs
};

}  // namespace earshot::ocean
