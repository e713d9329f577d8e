#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/charts/geo_grid.hpp"
#include "sim/ocean/charts/geography.hpp"

namespace earshot::ocean {

/// An elevation beyond these is none on this earth.
inline constexpr double kDeepestSeaFloor_m = 12'000.0;
inline constexpr double kHighestLand_m = 10'000.0;

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

/// Throws host::BadInput for an elevation that cannot be beside its neighbours: a fill value that the file does not declare (-9999), or a
/// spike. Oracle: Bathymetry.RefusesAFillValueThatCouldBeADepth
void require_no_stray_node(const Bathymetry& chart, const std::string& variable);

/// Reads the part within `reach` of a centre from a NetCDF file in GEBCO's layout: `elevation(lat, lon)` in metres, positive up.
/// Throws netcdf::FileError when the file is not that or does not cover the centre.
[[nodiscard]] Bathymetry read_gebco(const std::filesystem::path& path, GeoPosition centre, Meters reach);

}  // namespace earshot::ocean
