#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/charts/geo_grid.hpp"
#include "sim/ocean/charts/geography.hpp"
#include "sim/ocean/water/sea_water.hpp"
#include "sim/ocean/water/sound_speed.hpp"

namespace earshot::ocean {

/// Temperature and salinity on a latitude-longitude-depth grid.
struct Climatology {
  std::string file;  ///< where it came from, for messages
  GeoAxes axes;
  std::vector<double> depth_m;        ///< strictly increasing from 0, positive down
  std::vector<double> temperature_c;  ///< [n_depth x n_latitude x n_longitude], in situ; NaN on land and below the sea floor
  std::vector<double> salinity_psu;   ///< likewise
};

/// Files in the layout of the World Ocean Atlas. Both may be the same file.
struct WorldOceanAtlas {
  std::filesystem::path temperature;  ///< t_an([time,] depth, lat, lon) in degC
  std::filesystem::path salinity;     ///< s_an([time,] depth, lat, lon)
};

/// Reads the part within `reach` of a centre, the first of several times.
/// Throws netcdf::FileError when a file is not in that layout, does not cover the centre, differs from the other in its grid, or has water
/// below a depth without data.
[[nodiscard]] Climatology read_world_ocean_atlas(const WorldOceanAtlas& files, GeoPosition centre, Meters reach);

/// Sound speed at a position.
///
/// Temperature and salinity are bilinear between the four nodes about it at each depth of the grid; a node that is on land or below the sea
/// floor there is left out and the others' weights are scaled up. The profile ends where no node has data; from there down to 12 km the
/// deepest temperature and salinity are kept and pressure alone raises the sound speed. Throws host::BadInput where there is no
/// water; data_end_at says where that begins. Oracle: Climatology.*
[[nodiscard]] TabulatedProfile profile_at(const Climatology& climatology, GeoPosition position, SoundSpeedFormula formula);

/// The depth of the deepest temperature and salinity that `profile_at` has there. Throws as it does.
[[nodiscard]] Meters data_end_at(const Climatology& climatology, GeoPosition position);

}  // namespace earshot::ocean
