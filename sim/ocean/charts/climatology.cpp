#include "sim/ocean/charts/climatology.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>

#include "sim/ocean/water/sea_water.hpp"

namespace earshot::ocean {
namespace {

constexpr double kDeepest_m = 12'000.0;
constexpr double kExtensionStep_m = 500.0;  // sound speed over so much pressure bends by 0.01 m/s

struct Field {
  GeoAxes axes;
  std::vector<double> depth_m;
  std::vector<double> values;
};

std::vector<double> read_depth(const netcdf::Reader& file) {
  require_units(file, "depth", {"m", "meters", "meter", "metres", "metre"});
  std::vector<double> depth_m = file.read("depth");
  file.require("depth", depth_m, host::Range::between(0.0, kDeepest_m));
  if (depth_m.empty() || depth_m.front() != 0.0) throw file.error("depth", "must begin at 0");
  for (std::size_t i = 1; i < depth_m.size(); ++i) {
    if (!(depth_m[i] > depth_m[i - 1])) throw file.error("depth", "must increase throughout (positive down)");
  }
  return depth_m;
}

/// "latitude 44.5, longitude -9.5, depth 100 m" of a value.
std::string place_of(const Field& field, std::size_t i) {
  const std::size_t columns = field.axes.longitude_deg.size();
  const std::size_t nodes = field.axes.latitude_deg.size() * columns;
  std::ostringstream text;
  text << "latitude " << field.axes.latitude_deg[i % nodes / columns] << ", longitude " << field.axes.longitude_deg[i % columns]
       << ", depth " << field.depth_m[i / nodes] << " m";
  return text.str();
}

/// A column of water has no hole in it: data end at the sea floor and do not begin again.
void require_no_gaps(const netcdf::Reader& file, const std::string& variable, const Field& field) {
  const std::size_t nodes = field.axes.latitude_deg.size() * field.axes.longitude_deg.size();
  for (std::size_t i = nodes; i < field.values.size(); ++i) {
    if (std::isnan(field.values[i]) || !std::isnan(field.values[i - nodes])) continue;
    throw file.error(variable, "gap at " + place_of(field, i - nodes) + ": there are data below it");
  }
}

void require_range(const netcdf::Reader& file, const std::string& variable, const Field& field, double lowest, double highest) {
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double x = field.values[i];
    if (std::isnan(x) || (x >= lowest && x <= highest)) continue;
    std::ostringstream text;
    text << "holds " << x << " at " << place_of(field, i) << ", must be from " << lowest << " to " << highest;
    throw file.error(variable, text.str());
  }
}

Field read_field(const netcdf::Reader& file, const std::string& variable, GeoPosition centre, Meters reach) {
  const GeoWindow window(file, centre, reach);
  const auto& [lat, lon] = window.dimensions();
  const std::vector<std::string> with_time = {"time", "depth", lat, lon};
  const std::vector<std::string> without = {"depth", lat, lon};
  const std::vector<std::string> dimensions = file.dimensions_of(variable);
  if (dimensions != with_time && dimensions != without) {
    throw file.error(variable, "must have the dimensions (time, depth, " + lat + ", " + lon + "), or all but time");
  }
  if (dimensions == with_time && file.shape_of(variable).front() != 1) {
    throw file.error(variable,
                     "has " + std::to_string(file.shape_of(variable).front()) + " times, must have one: cut the month or season out");
  }
  Field field{.axes = window.axes(), .depth_m = read_depth(file), .values = {}};
  std::vector<std::size_t> leading = {field.depth_m.size()};
  if (dimensions == with_time) leading.insert(leading.begin(), 1);
  field.values = window.read(file, variable, leading);
  require_no_gaps(file, variable, field);
  return field;
}

/// The weighted mean of a level over the nodes that have water there.
std::optional<SeaWater> water_at(const Climatology& c, const GeoCell& cell, std::size_t level) {
  const std::size_t first = level * c.axes.latitude_deg.size() * c.axes.longitude_deg.size();
  SeaWater sum{.temperature_c = 0.0, .salinity_psu = 0.0};
  double weight = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double t = c.temperature_c[first + cell.node[i]];
    const double s = c.salinity_psu[first + cell.node[i]];
    if (std::isnan(t) || std::isnan(s)) continue;
    sum.temperature_c += cell.weight[i] * t;
    sum.salinity_psu += cell.weight[i] * s;
    weight += cell.weight[i];
  }
  if (!(weight > 0.0)) return std::nullopt;
  return SeaWater{.temperature_c = sum.temperature_c / weight, .salinity_psu = sum.salinity_psu / weight};
}

/// From the surface down, as many levels as there are data for; at least one.
std::vector<SeaWater> levels_at(const Climatology& climatology, GeoPosition position) {
  const auto cell = cell_at(climatology.axes, position);
  std::vector<SeaWater> levels;
  while (cell && levels.size() < climatology.depth_m.size()) {
    const std::optional<SeaWater> water = water_at(climatology, *cell, levels.size());
    if (!water) break;
    levels.push_back(*water);
  }
  if (!levels.empty()) return levels;
  std::ostringstream text;
  text << climatology.file << ": no water at latitude " << position.latitude_deg << ", longitude " << position.longitude_deg
       << (cell ? "" : " (outside the file or the reach_km that was read)");
  throw host::BadInput(text.str());
}

}  // namespace

Climatology read_world_ocean_atlas(const WorldOceanAtlas& files, GeoPosition centre, Meters reach) {
  const netcdf::Reader temperature_file(files.temperature);
  const netcdf::Reader salinity_file(files.salinity);
  require_units(temperature_file, "t_an", {"degrees_celsius", "degree_Celsius", "degrees_Celsius", "degree_C", "degC", "Celsius"});
  require_units(salinity_file, "s_an", {"1", "psu", "PSU", "1e-3", "dimensionless"});
  Field temperature = read_field(temperature_file, "t_an", centre, reach);
  Field salinity = read_field(salinity_file, "s_an", centre, reach);
  require_range(temperature_file, "t_an", temperature, -3.0, 45.0);
  require_range(salinity_file, "s_an", salinity, 0.0, 50.0);
  if (temperature.axes.latitude_deg != salinity.axes.latitude_deg || temperature.axes.longitude_deg != salinity.axes.longitude_deg ||
      temperature.depth_m != salinity.depth_m) {
    throw salinity_file.error("s_an", "must have the grid of t_an in " + files.temperature.string());
  }
  return {.file = files.temperature.string(),
          .axes = std::move(temperature.axes),
          .depth_m = std::move(temperature.depth_m),
          .temperature_c = std::move(temperature.values),
          .salinity_psu = std::move(salinity.values)};
}

TabulatedProfile profile_at(const Climatology& climatology, GeoPosition position, SoundSpeedFormula formula) {
  const Radians latitude{position.latitude_deg * std::numbers::pi / 180.0};
  TabulatedProfile profile;
  const auto add = [&](const SeaWater& water, double depth_m) {
    profile.depth_m.push_back(depth_m);
    profile.sound_speed_mps.push_back(sound_speed_of(water, Meters{depth_m}, latitude, formula).value);
  };
  const std::vector<SeaWater> levels = levels_at(climatology, position);
  for (std::size_t level = 0; level < levels.size(); ++level) add(levels[level], climatology.depth_m[level]);
  while (profile.depth_m.back() < kDeepest_m) add(levels.back(), std::min(profile.depth_m.back() + kExtensionStep_m, kDeepest_m));
  return profile;
}

Meters data_end_at(const Climatology& climatology, GeoPosition position) {
  return Meters{climatology.depth_m[levels_at(climatology, position).size() - 1]};
}

}  // namespace earshot::ocean
