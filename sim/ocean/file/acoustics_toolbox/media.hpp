#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/ocean/environment.hpp"
#include "sim/ocean/file/acoustics_toolbox/top_options.hpp"
#include "sim/ocean/file/list_directed/list_reader.hpp"

namespace earshot::ocean::acoustics_toolbox {

/// A fluid at a depth, in Earshot's units.
struct FluidPoint {
  double depth_m;
  double sound_speed_mps;
  double density_g_per_cm3;
  double attenuation_db_per_wavelength;
};

/// Points of one medium, from its top to its bottom, two at least.
using Medium = std::vector<FluidPoint>;

/// Reads lines of depth, sound speed, shear speed, density, attenuation and shear attenuation: of the media and of the half-space below.
///
/// A line may end with a slash before its last value; those that it leaves out are as they were on the line before, at first 1500 m/s, no
/// shear, 1 g/cm3, no attenuation.
class FluidLines {
 public:
  FluidLines(ListReader& file, const TopOptions& options, Hertz frequency) : file_(file), options_(options), frequency_(frequency) {}

  /// Lines from `top_m` to `bottom_m`. Throws host::BadInput naming the line where they are not that, or are of a solid.
  [[nodiscard]] Medium medium(double top_m, double bottom_m);
  /// One line; its depth means nothing.
  [[nodiscard]] FluidPoint half_space();
  /// What stands in one line from its second value on: of a bathymetry file, too.
  [[nodiscard]] FluidPoint fluid(std::array<double, 6> line) const;

 private:
  [[nodiscard]] FluidPoint next(const std::string& what);

  ListReader& file_;
  const TopOptions& options_;
  Hertz frequency_;
  std::array<double, 6> line_{0.0, 1500.0, 0.0, 1.0, 0.0, 0.0};
};

/// What sound travels through, of the media of a file and the half-space below them.
struct Fluids {
  TabulatedProfile water;
  double absorption_db_per_km;
  std::vector<SedimentLayer> sediment;
  double water_density_g_per_cm3;  ///< in the file; densities of the sediment are relative to it
};

/// Throws host::BadInput naming the file where sea water has no one density or absorption, or a sediment's sound speed goes on between
/// depths in a way that it cannot.
/// @param media  the water first
[[nodiscard]] Fluids fluids_of(const ListReader& file, const std::vector<Medium>& media, const FluidPoint& half_space,
                               const TopOptions& options, Hertz frequency);

/// @param water_density_g_per_cm3  the sediment's is relative to it
[[nodiscard]] SedimentLayer half_space_layer(const FluidPoint& fluid, double water_density_g_per_cm3);

}  // namespace earshot::ocean::acoustics_toolbox
