#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "sim/ocean/section.hpp"
#include "sim/pe/sediment_points.hpp"

namespace earshot::pe::tests {

/// A section written short, in metres, m/s, g/cm3 and dB per wavelength: the sea floor as ranges and depths, water and sediment from their
/// ranges on. Sediment is given by its points, as sediment_points() returns them: one, or the top and the base of each layer and the top
/// of the half-space.
struct ShortSection {
  std::vector<std::pair<double, double>> floor;
  std::vector<std::pair<double, ocean::SoundSpeedProfile>> water;
  std::vector<std::pair<double, std::vector<SedimentPoint>>> sediment;
  double absorption_db_per_km = 0.0;
};

inline std::vector<ocean::SeaFloorStation> sea_floor(const std::vector<std::pair<double, double>>& floor) {
  std::vector<ocean::SeaFloorStation> stations;
  for (const auto& [range_m, depth_m] : floor) stations.push_back({.range = Meters{range_m}, .depth = Meters{depth_m}});
  return stations;
}

inline std::vector<ocean::SedimentLayer> layers_between(const std::vector<SedimentPoint>& points) {
  std::vector<ocean::SedimentLayer> layers;
  for (std::size_t i = 0; i < points.size(); i += 2) {
    const SedimentPoint& top = points[i];
    layers.push_back({.thickness = {},
                      .sound_speed = MetersPerSecond{top.sound_speed_mps},
                      .density_g_per_cm3 = top.density_g_per_cm3,
                      .attenuation_db_per_wavelength = top.attenuation_db_per_wavelength});
    if (i + 1 == points.size()) break;
    const SedimentPoint& base = points[i + 1];
    layers.back().thickness = Meters{base.depth_below_floor_m - top.depth_below_floor_m};
    layers.back().sound_speed_at_base = MetersPerSecond{base.sound_speed_mps};
    layers.back().density_at_base_g_per_cm3 = base.density_g_per_cm3;
    layers.back().attenuation_at_base_db_per_wavelength = base.attenuation_db_per_wavelength;
  }
  return layers;
}

inline ocean::Section section_of(const ShortSection& s) {
  ocean::Section section{.water = {}, .sea_floor = sea_floor(s.floor), .sediment = {}, .absorption_db_per_km = s.absorption_db_per_km};
  for (const auto& [range_m, profile] : s.water) section.water.push_back({.range = Meters{range_m}, .profile = profile});
  for (const auto& [range_m, points] : s.sediment) section.sediment.push_back({.range = Meters{range_m}, .layers = layers_between(points)});
  return section;
}

}  // namespace earshot::pe::tests
