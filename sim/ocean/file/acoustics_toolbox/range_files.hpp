#pragma once

#include <filesystem>
#include <vector>

#include "sim/ocean/environment.hpp"
#include "sim/ocean/file/acoustics_toolbox/media.hpp"

namespace earshot::ocean::acoustics_toolbox {

/// What changes with range in a .bty file. Stations begin at range 0; what the file says behind the source is left out.
struct Bathymetry {
  std::vector<SeaFloorStation> sea_floor;
  std::vector<SedimentStation> sediment;  ///< of the long format; empty: that of the .env file at every range
};

/// Reads the sea floor against range, linear between its points. Curved interpolation ('C') bends how BELLHOP's beams are reflected, not
/// where the floor is.
/// @param options  of the .env file, whose units the long format has
/// @param deepest  to where the profile of the water goes
/// Throws host::BadInput naming the line.
[[nodiscard]] Bathymetry read_bathymetry(const std::filesystem::path& path, Meters deepest, const TopOptions& options, Hertz frequency,
                                         double water_density_g_per_cm3);

/// Reads an .ssp file: sound speed at each of `depth_m`, a line for each depth with a number for each range.
[[nodiscard]] std::vector<WaterStation> read_water(const std::filesystem::path& path, const std::vector<double>& depth_m);

}  // namespace earshot::ocean::acoustics_toolbox
