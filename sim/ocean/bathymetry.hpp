#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/geo_grid.hpp"
#include "sim/ocean/geography.hpp"

namespace earshot::ocean {

/// Height of the solid earth on a latitude-longitude grid, bilinear between its nodes.
struct Bathymetry {
  std::string file;  ///< where it came from, for messages
  GeoAxes axes;
  std::vector<double> elevation_m;  ///< [n_latitude x n_longitude], above the sea surface: negative at sea
};

/// @return positive down; negative on land
/// Throws host::BadInput where the grid has no value.
/// Oracle: Bathymetry.IsBilinearBetweenItsNodes
[[nodiscard]] Meters sea_floor_depth(const Bathymetry& bathymetry, GeoPosition position);

/// Reads the part within `reach` of a centre from a NetCDF file in GEBCO's layout: `elevation(lat, lon)` in metres, positive up.
/// Throws netcdf::FileError when the file is not that or does not cover the centre.
[[nodiscard]] Bathymetry read_gebco(const std::filesystem::path& path, GeoPosition centre, Meters reach);

/// Reads a whole grid from a CSV file with the columns latitude_deg, longitude_deg and elevation_m, one line for each node, in any order.
/// Throws host::BadInput when a node is missing or there twice.
[[nodiscard]] Bathymetry read_bathymetry_csv(const std::filesystem::path& path, GeoPosition centre);

/// Reads a section from a CSV file with the columns range_m (increasing) and depth_m (0 on the shore, which only the last may be).
/// Throws host::BadInput when it is not that.
[[nodiscard]] std::vector<SeaFloorStation> read_section_csv(const std::filesystem::path& path);

}  // namespace earshot::ocean
