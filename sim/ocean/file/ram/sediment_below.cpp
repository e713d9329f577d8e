#include "sim/ocean/file/ram/sediment_below.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "sim/ocean/stations.hpp"

namespace earshot::ocean::ram {
namespace {

/// Speed, density and attenuation.
using Fluid = std::array<double, 3>;

Fluid fluid_at(const Block& block, double depth_m) {
  return {block.sediment_speed_mps.at(depth_m), block.sediment_density_g_per_cm3.at(depth_m),
          block.sediment_attenuation_db_per_wavelength.at(depth_m)};
}

SedimentLayer layer_of(const Fluid& top) {
  return {
      .thickness = Meters{}, .sound_speed = MetersPerSecond{top[0]}, .density_g_per_cm3 = top[1], .attenuation_db_per_wavelength = top[2]};
}

SedimentLayer layer_between(const Fluid& top, const Fluid& base, double thickness_m) {
  SedimentLayer layer = layer_of(top);
  layer.thickness = Meters{thickness_m};
  if (base[0] != top[0]) layer.sound_speed_at_base = MetersPerSecond{base[0]};
  if (base[1] != top[1]) layer.density_at_base_g_per_cm3 = base[1];
  if (base[2] != top[2]) layer.attenuation_at_base_db_per_wavelength = base[2];
  return layer;
}

/// Depths between which all is linear, from the sea floor to where the file's numbers end.
std::vector<double> breaks_of(double sea_floor_m, const Block& block, double max_depth_m) {
  std::vector<double> breaks{sea_floor_m, max_depth_m};
  for (const DepthProfile* profile :
       {&block.sediment_speed_mps, &block.sediment_density_g_per_cm3, &block.sediment_attenuation_db_per_wavelength}) {
    std::copy_if(profile->depth_m.begin(), profile->depth_m.end(), std::back_inserter(breaks),
                 [&](double depth_m) { return depth_m > sea_floor_m && depth_m < max_depth_m; });
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

/// Whether a block's sediment is the same at all of these depths, so that it does not matter where the sea floor lies among them.
bool is_uniform(const Block& block, double from_m, double to_m) {
  const std::vector<double> breaks = breaks_of(from_m, block, to_m);
  return std::all_of(breaks.begin(), breaks.end(), [&](double depth_m) { return fluid_at(block, depth_m) == fluid_at(block, from_m); });
}

double floor_at(const RamInput& input, double range_m) {
  const Between at = stations_about(input.sea_floor, Meters{range_m});
  return mix(input.sea_floor[at.below].depth, input.sea_floor[at.above].depth, at.fraction).value;
}

/// Ranges at which a station stands: between them the sea floor moves by `step_m` at most.
std::vector<double> station_ranges(const RamInput& input, double step_m) {
  std::vector<double> ranges{0.0};
  for (const Block& block : input.blocks) ranges.push_back(block.range_m);
  for (std::size_t i = 1; i < input.sea_floor.size(); ++i) {
    const SeaFloorStation& from = input.sea_floor[i - 1];
    const SeaFloorStation& to = input.sea_floor[i];
    const double count = std::max(1.0, std::ceil(std::abs((to.depth - from.depth).value) / step_m));
    for (double part = 1.0; part <= count; part += 1.0) ranges.push_back(mix(from.range, to.range, part / count).value);
  }
  std::sort(ranges.begin(), ranges.end());
  ranges.erase(std::unique(ranges.begin(), ranges.end()), ranges.end());
  std::erase_if(ranges, [&input](double range_m) { return range_m > 0.0 && range_m >= input.max_range_m; });
  return ranges;
}

/// How far the sea floor goes up and down on its way.
double way_of_floor_m(const RamInput& input) {
  double way_m = 0.0;
  for (std::size_t i = 1; i < input.sea_floor.size(); ++i)
    way_m += std::abs((input.sea_floor[i].depth - input.sea_floor[i - 1].depth).value);
  return way_m;
}

}  // namespace

std::vector<SedimentLayer> sediment_below(double sea_floor_m, const Block& block, double max_depth_m) {
  const std::vector<double> breaks = breaks_of(sea_floor_m, block, std::max(max_depth_m, sea_floor_m));
  std::size_t last = breaks.size() - 1;
  while (last > 0 && fluid_at(block, breaks[last - 1]) == fluid_at(block, breaks[last])) --last;
  std::vector<SedimentLayer> layers;
  for (std::size_t i = 0; i < last; ++i)
    layers.push_back(layer_between(fluid_at(block, breaks[i]), fluid_at(block, breaks[i + 1]), breaks[i + 1] - breaks[i]));
  layers.push_back(layer_of(fluid_at(block, breaks[last])));
  return layers;
}

std::vector<SedimentStation> sediment_stations(const RamInput& input, double step_m) {
  constexpr double kMostStations = 5000.0;
  const auto by_depth = [](const SeaFloorStation& a, const SeaFloorStation& b) { return a.depth < b.depth; };
  const double shallowest_m = std::min_element(input.sea_floor.begin(), input.sea_floor.end(), by_depth)->depth.value;
  const bool follows_floor = std::all_of(input.blocks.begin(), input.blocks.end(),
                                         [&](const Block& block) { return is_uniform(block, shallowest_m, input.max_depth_m); });
  std::vector<double> ranges;
  if (follows_floor) {
    for (const Block& block : input.blocks) ranges.push_back(block.range_m);
  } else {
    ranges = station_ranges(input, std::max(step_m, way_of_floor_m(input) / kMostStations));
  }
  std::vector<SedimentStation> stations;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double end_m = i + 1 < ranges.size() ? ranges[i + 1] : std::max(ranges[i], input.max_range_m);
    const auto after = std::find_if(input.blocks.begin(), input.blocks.end(), [&](const Block& b) { return b.range_m > ranges[i]; });
    const double floor_m = floor_at(input, 0.5 * (ranges[i] + end_m));
    stations.push_back({.range = Meters{ranges[i]}, .layers = sediment_below(floor_m, *std::prev(after), input.max_depth_m)});
  }
  return stations;
}

}  // namespace earshot::ocean::ram
