#include "sim/ocean/file/environment_water.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace earshot::ocean {
namespace {

using host::Range;
using host::TableReader;

constexpr double kMaxDepth_m = 12'000.0;
constexpr Range kSoundSpeed = {100.0, 10'000.0, Range::Lower::kAtLeast};

MunkProfile read_munk(TableReader& table) {
  return {.axis_sound_speed = MetersPerSecond{table.number("axis_sound_speed_mps", kSoundSpeed)},
          .axis_depth = Meters{table.number("axis_depth_m", Range::between(0.0, kMaxDepth_m))},
          .scale = Meters{table.number("scale_m", Range::above_up_to(0.0, kMaxDepth_m))},
          .perturbation = table.number("perturbation", Range::between(0.0, 0.1))};
}

TabulatedProfile read_table(TableReader& table) {
  TabulatedProfile profile{.depth_m = table.numbers("depth_m", Range::between(0.0, kMaxDepth_m)),
                           .sound_speed_mps = table.numbers("sound_speed_mps", kSoundSpeed)};
  if (table.is_noted("depth_m") || table.is_noted("sound_speed_mps")) return profile;
  const auto& depth = profile.depth_m;
  if (depth.size() != profile.sound_speed_mps.size()) {
    table.problem("sound_speed_mps", "has " + std::to_string(profile.sound_speed_mps.size()) + " values, must have one for each of the " +
                                         std::to_string(depth.size()) + " of depth_m");
  }
  const auto stuck = std::adjacent_find(depth.begin(), depth.end(), std::greater_equal<>());
  if (depth.empty()) {
    table.problem("depth_m", "must hold at least one depth");
  } else if (stuck != depth.end()) {
    table.problem("depth_m", "must increase: value number " + std::to_string(stuck - depth.begin() + 2) + " does not");
  } else if (depth.front() > 0.0) {
    table.problem("depth_m", "must begin at 0");
  }
  return profile;
}

std::vector<WaterStation> read_stations(TableReader& table) {
  std::vector<WaterStation> stations;
  for (TableReader& station : table.tables("stations", kMostWaterStations)) {
    const Meters range{station.number("range_m", Range::at_least(0.0))};
    const bool follows = stations.empty() || range > stations.back().range;
    if (!follows && !station.is_noted("range_m")) station.problem("range_m", "must be more than the station's before");
    stations.push_back({.range = range, .profile = read_table(station)});
  }
  if (stations.empty()) table.problem("stations", "must hold at least one station");
  return stations;
}

SoundSpeedFormula read_formula(TableReader& table) {
  return static_cast<SoundSpeedFormula>(table.choice_or("formula", 0, {"unesco", "mackenzie"}));
}

}  // namespace

WaterData read_water(const host::TomlFile& file, TableReader table, Environment& environment) {
  switch (table.choice("profile", {"munk", "table", "csv", "woa"})) {
    case 1:
      if (table.has("stations")) {
        environment.water_stations = read_stations(table);
        if (!environment.water_stations.empty()) environment.water = environment.water_stations.front().profile;
      } else {
        environment.water = read_table(table);
      }
      return {};
    case 2: {
      const std::string csv = table.text("file");
      return WaterCsv{.file = file.resolve(csv), .formula = read_formula(table)};
    }
    case 3: {
      const std::string temperature = table.text("temperature_file");
      const std::string salinity = table.text_or("salinity_file", temperature);
      const SoundSpeedFormula formula = read_formula(table);
      return WaterAtlas{.files = {.temperature = file.resolve(temperature), .salinity = file.resolve(salinity)},
                        .formula = formula,
                        .reach = Meters{1000.0 * table.number_or("reach_km", 150.0, Range::above_up_to(0.0, 5000.0))}};
    }
    default:
      environment.water = read_munk(table);
      return {};
  }
}

AbsorbingWater read_absorption(TableReader table) {
  const SeaWater water{.temperature_c = table.number("temperature_c", Range::between(-2.0, 40.0)),
                       .salinity_psu = table.number("salinity_psu", Range::between(0.0, 50.0)),
                       .acidity_ph_nbs = table.number_or("acidity_ph_nbs", 8.0, Range::between(7.0, 9.0))};
  return {.water = water, .depth = Meters{table.number("depth_m", Range::between(0.0, kMaxDepth_m))}};
}

}  // namespace earshot::ocean
