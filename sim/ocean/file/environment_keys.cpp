#include "sim/ocean/file/environment_keys.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "sim/ocean/charts/bathymetry.hpp"
#include "sim/ocean/file/environment_noise.hpp"
#include "sim/ocean/water/sea_water.hpp"

namespace earshot::ocean {
namespace {

using host::Range;
using host::TableReader;

constexpr double kMaxDepth_m = 12'000.0;  // deeper than any ocean: whoever exceeds it has mistaken the unit
constexpr double kFurthest_m = 1e6;       // from the origin: a plane further out than that is none on this earth

Source read_source(TableReader& table) {
  const Range in_plane = Range::between(-kFurthest_m, kFurthest_m);
  return {.frequency = Hertz{table.number("frequency_hz", Range::between(1.0, 10'000.0))},
          .level = Decibels{table.number("level_db_re_1upa_at_1m", Range::between(0.0, 300.0))},
          .depth = Meters{table.number("depth_m", Range::above_up_to(0.0, kMaxDepth_m))},
          .position = {.north = Meters{table.number("north_m", in_plane)}, .east = Meters{table.number("east_m", in_plane)}}};
}

GeoPosition read_origin(TableReader table) {
  return {.latitude_deg = table.number("latitude_deg", Range::between(-90.0, 90.0)),
          .longitude_deg = table.number("longitude_deg", Range::between(-180.0, 180.0))};
}

constexpr SeaFloorStation kHarmless{.range = Meters{}, .depth = Meters{1.0}};  // what is read after a problem must not mislead

std::vector<SeaFloorStation> read_section(TableReader& table) {
  const std::vector<double> range_m = table.numbers("range_m", Range::between(0.0, 1e8));
  const std::vector<double> depth_m = table.numbers("depth_m", Range::between(0.0, kDeepestSeaFloor_m));
  if (table.is_noted("range_m") || table.is_noted("depth_m")) return {kHarmless};
  if (range_m.empty() || range_m.size() != depth_m.size()) {
    table.problem("range_m", "must hold one range or more, one for each of depth_m");
    return {kHarmless};
  }
  std::vector<SeaFloorStation> stations;
  for (std::size_t i = 0; i < range_m.size(); ++i) {
    const std::string number = "value number " + std::to_string(i + 1);
    if (i > 0 && !(range_m[i] > range_m[i - 1])) {
      table.problem("range_m", "must increase: " + number + " does not");
      return {kHarmless};
    }
    if (depth_m[i] == 0.0 && (i == 0 || i + 1 < range_m.size())) {
      table.problem("depth_m", "must be above 0 everywhere but in the last of two or more, which may be the shore: " + number + " is not");
      return {kHarmless};
    }
    stations.push_back({.range = Meters{range_m[i]}, .depth = Meters{depth_m[i]}});
  }
  return stations;
}

BathymetryKeys read_bathymetry(const host::TomlFile& file, TableReader table) {
  BathymetryKeys keys{.layout = static_cast<BathymetryLayout>(table.choice("layout", {"section_csv", "grid_csv", "gebco", "section"})),
                      .file = {},
                      .reach = {}};
  if (keys.layout == BathymetryLayout::kSection) {
    keys.section = read_section(table);
    return keys;
  }
  keys.file = file.resolve(table.text("file"));
  if (keys.layout == BathymetryLayout::kGebco) {
    keys.reach = Meters{1000.0 * table.number_or("reach_km", 150.0, Range::above_up_to(0.0, 5000.0))};
  }
  return keys;
}

/// Tables of depths reach as deep as a flat sea floor.
void check_reach(TableReader& water, const Environment& environment) {
  const auto is_short = [&](const SoundSpeedProfile& profile) {
    const auto* table = std::get_if<TabulatedProfile>(&profile);
    return table != nullptr && !table->depth_m.empty() && table->depth_m.back() < environment.seabed.depth.value;
  };
  const auto& stations = environment.water_stations;
  if (is_short(environment.water) || std::any_of(stations.begin(), stations.end(), [&](const auto& s) { return is_short(s.profile); })) {
    water.problem("depth_m", "must extend from 0 to seabed.depth_m");
  }
}

}  // namespace

EnvironmentKeys read_environment_keys(const host::TomlFile& file, const FurtherTables& further) {
  TableReader root = file.root();
  TableReader source = root.table("source");
  TableReader water = root.table("water");
  EnvironmentKeys keys;
  Environment& environment = keys.environment;
  environment.name = root.text("name");
  environment.source = read_source(source);
  environment.noise_level = read_noise(root.table("noise"));
  keys.water = read_water(file, water, environment);
  if (const auto origin = root.optional_table("origin")) keys.origin = read_origin(*origin);
  if (const auto absorption = root.optional_table("absorption")) {
    const AbsorbingWater& absorbing = environment.absorbing.emplace(read_absorption(*absorption));
    environment.absorption_db_per_km = absorption_db_per_km(absorbing.water, absorbing.depth, environment.source.frequency);
  }
  if (const auto bathymetry = root.optional_table("bathymetry")) keys.bathymetry = read_bathymetry(file, *bathymetry);
  read_seabed(root.table("seabed"), keys.bathymetry ? SeaFloorDepth::kGivenByBathymetry : SeaFloorDepth::kGivenHere, environment);
  if (further) further(file, root, keys);
  const bool chart =
      keys.bathymetry && (keys.bathymetry->layout == BathymetryLayout::kGridCsv || keys.bathymetry->layout == BathymetryLayout::kGebco);
  if (!keys.origin && (chart || std::holds_alternative<WaterAtlas>(keys.water))) {
    root.problem("origin", "must be there, with latitude_deg and longitude_deg: where north_m = 0, east_m = 0 lies on the charts");
  }
  file.finish();
  if (!keys.bathymetry) {  // how values that are right by themselves fit each other
    check_reach(water, environment);
    if (!(environment.source.depth < environment.seabed.depth)) source.problem("depth_m", "must be less than seabed.depth_m");
  }
  file.finish();
  return keys;
}

}  // namespace earshot::ocean
