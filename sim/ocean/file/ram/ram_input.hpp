#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/ocean/environment.hpp"
#include "sim/ocean/file/list_directed/list_reader.hpp"

namespace earshot::ocean::ram {

/// What a file states against depth: linear between its points, constant above the first and below the last.
struct DepthProfile {
  std::vector<double> depth_m;  ///< increasing, >= 0, at least one
  std::vector<double> value;    ///< as many

  [[nodiscard]] double at(double depth_m) const;
};

/// What holds from a range on. The sediment's depths are measured from the sea surface.
struct Block {
  double range_m;
  DepthProfile water_speed_mps;
  DepthProfile sediment_speed_mps;
  DepthProfile sediment_density_g_per_cm3;
  DepthProfile sediment_attenuation_db_per_wavelength;
};

/// The numbers of a ram.in file, by its own names where they are RAM's: dr, ndr, dz, ndz, zmplt are those of its output.
struct RamInput {
  std::string title;
  double frequency_hz;
  double source_depth_m;
  double max_range_m;
  double range_step_m;      ///< dr
  std::size_t range_every;  ///< ndr: steps between two ranges written; of `range_steps` at most
  std::size_t range_steps;  ///< dr to the last range, the first at rmax or beyond; 2 at least
  double max_depth_m;       ///< zmax
  double depth_step_m;      ///< dz
  std::size_t depth_every;  ///< ndz
  double written_depth_m;   ///< zmplt
  std::vector<SeaFloorStation> sea_floor;
  std::vector<Block> blocks;  ///< the first at range 0, range increasing
};

/// Reads the input of RAM 1.5. Throws host::BadInput naming the line.
///
/// A depth that stands twice is a step: RAM puts the second a depth step further down, and so does this.
/// Source: Collins, User's Guide for RAM Versions 1.0 and 1.0p, Naval Research Laboratory. Oracle: RamFile.*
[[nodiscard]] RamInput read_ram_input(const std::filesystem::path& path);

}  // namespace earshot::ocean::ram
