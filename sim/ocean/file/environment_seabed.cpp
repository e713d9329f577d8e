#include "sim/ocean/file/environment_seabed.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace earshot::ocean {
namespace {

using host::Range;
using host::TableReader;

constexpr double kMaxDepth_m = 12'000.0;  // deeper than any ocean: whoever exceeds it has mistaken the unit

const Range kSoundSpeed_mps = Range::between(100.0, 10'000.0);
const Range kDensity_g_per_cm3 = Range::between(0.5, 20.0);
const Range kAttenuation_db_per_wavelength = Range::between(0.0, 20.0);

/// What only a layer of finite thickness has.
void read_base(TableReader& table, SedimentLayer& layer) {
  const auto number = [&table](const std::string& key, Range range) {
    return table.has(key) ? std::optional(table.number(key, range)) : std::nullopt;
  };
  layer.thickness = Meters{table.number("thickness_m", Range::above_up_to(0.0, kMaxDepth_m))};
  if (const auto speed = number("sound_speed_at_base_mps", kSoundSpeed_mps)) layer.sound_speed_at_base = MetersPerSecond{*speed};
  layer.density_at_base_g_per_cm3 = number("density_at_base_g_per_cm3", kDensity_g_per_cm3);
  layer.attenuation_at_base_db_per_wavelength = number("attenuation_at_base_db_per_wavelength", kAttenuation_db_per_wavelength);
}

void refuse_base(TableReader& table) {
  for (const char* key : {"thickness_m", "sound_speed_at_base_mps", "density_at_base_g_per_cm3", "attenuation_at_base_db_per_wavelength"}) {
    if (!table.has(key)) continue;
    (void)table.number(key);
    table.problem(key, "must be left out of the last layer, which is a half-space");
  }
}

SedimentLayer read_layer(TableReader table, bool is_last) {
  SedimentLayer layer{
      .thickness = Meters{},
      .sound_speed = MetersPerSecond{table.number("sound_speed_mps", kSoundSpeed_mps)},
      .density_g_per_cm3 = table.number_or("density_g_per_cm3", 1.5, kDensity_g_per_cm3),
      .attenuation_db_per_wavelength = table.number_or("attenuation_db_per_wavelength", 0.5, kAttenuation_db_per_wavelength)};
  if (is_last) {
    refuse_base(table);
  } else {
    read_base(table, layer);
  }
  return layer;
}

std::vector<SedimentLayer> read_layers(TableReader& table) {
  std::vector<SedimentLayer> layers;
  const std::vector<TableReader> tables = table.tables("layers");
  for (std::size_t i = 0; i < tables.size(); ++i) layers.push_back(read_layer(tables[i], i + 1 == tables.size()));
  if (table.has("layers") && layers.empty()) table.problem("layers", "must hold at least one layer");
  return layers;
}

std::vector<SedimentStation> read_stations(TableReader& table) {
  std::vector<SedimentStation> stations;
  for (TableReader& station : table.tables("stations")) {
    const Meters range{station.number("range_m", Range::at_least(0.0))};
    const bool follows = stations.empty() || range > stations.back().range;
    if (!follows && !station.is_noted("range_m")) station.problem("range_m", "must be more than the station's before");
    stations.push_back({.range = range, .layers = read_layers(station)});
  }
  if (stations.empty()) table.problem("stations", "must hold at least one station");
  return stations;
}

}  // namespace

void read_seabed(TableReader table, SeaFloorDepth depth, Environment& environment) {
  Seabed& seabed = environment.seabed;
  seabed.depth = Meters{1.0};
  if (depth == SeaFloorDepth::kGivenHere) {
    seabed.depth = Meters{table.number("depth_m", Range::above_up_to(0.0, kMaxDepth_m))};
  } else if (table.has("depth_m")) {
    (void)table.number("depth_m");
    table.problem("depth_m", "must be left out, [bathymetry] gives it");
  }
  if (table.has("stations")) {
    environment.sediment_stations = read_stations(table);
    if (!environment.sediment_stations.empty()) seabed.layers = environment.sediment_stations.front().layers;
    if (table.has("layers")) {
      (void)table.tables("layers");
      table.problem("layers", "must be left out, the stations have their own");
    }
  } else {
    seabed.layers = read_layers(table);
  }
}

}  // namespace earshot::ocean
