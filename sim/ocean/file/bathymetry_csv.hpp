#pragma once

#include <filesystem>
#include <vector>

#include "sim/ocean/charts/bathymetry.hpp"
#include "sim/ocean/environment.hpp"

namespace earshot::ocean {

/// Reads a whole grid from a CSV file with the columns latitude_deg, longitude_deg and elevation_m, one line for each node, in any order.
/// Throws host::BadInput when a node is missing or there twice.
[[nodiscard]] Bathymetry read_bathymetry_csv(const std::filesystem::path& path, GeoPosition centre);

/// Reads a section from a CSV file with the columns range_m (increasing) and depth_m (0 on the shore, which only the last may be).
/// Throws host::BadInput when it is not that.
[[nodiscard]] std::vector<SeaFloorStation> read_section_csv(const std::filesystem::path& path);

}  // namespace earshot::ocean
