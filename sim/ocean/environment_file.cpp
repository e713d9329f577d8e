#include "sim/ocean/environment_file.hpp"

#include <cstddef>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "firmware/config_file/table_reader.hpp"
#include "firmware/core/crc32.hpp"

namespace earshot::ocean {
namespace {

using config_file::Range;
using config_file::TableReader;

constexpr double kMaxDepth_m = 12'000.0;  // deeper than any ocean: whoever exceeds it has mistaken the unit
constexpr Range kSoundSpeed = {100.0, 10'000.0, Range::Lower::kAtLeast};

std::uint32_t crc32_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
  return crc32(bytes);
}

Source read_source(TableReader& table) {
  return {.frequency = Hertz{table.number("frequency_hz", Range::between(1.0, 10'000.0))},
          .level = Decibels{table.number("level_db_re_1upa_at_1m", Range::between(0.0, 300.0))},
          .depth = Meters{table.number("depth_m", Range::above_up_to(0.0, kMaxDepth_m))},
          .position = {.north = Meters{table.number("north_m")}, .east = Meters{table.number("east_m")}}};
}

MunkProfile read_munk(TableReader& table) {
  return {.axis_sound_speed = MetersPerSecond{table.number("axis_sound_speed_mps", kSoundSpeed)},
          .axis_depth = Meters{table.number("axis_depth_m", Range::between(0.0, kMaxDepth_m))},
          .scale = Meters{table.number("scale_m", Range::above_up_to(0.0, kMaxDepth_m))},
          .perturbation = table.number("perturbation", Range::between(0.0, 0.1))};
}

std::optional<std::size_t> first_not_increasing(const std::vector<double>& values) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(values[i] > values[i - 1])) return i;
  }
  return std::nullopt;
}

TabulatedProfile read_table(TableReader& table, Meters sea_floor) {
  TabulatedProfile profile{.depth_m = table.numbers("depth_m", Range::between(0.0, kMaxDepth_m)),
                           .sound_speed_mps = table.numbers("sound_speed_mps", kSoundSpeed)};
  const auto& depth = profile.depth_m;
  if (depth.size() != profile.sound_speed_mps.size()) {
    table.problem("sound_speed_mps", "has " + std::to_string(profile.sound_speed_mps.size()) + " values, must have one for each of the " +
                                         std::to_string(depth.size()) + " of depth_m");
  }
  if (depth.empty()) {
    table.problem("depth_m", "must hold at least one depth");
  } else if (const auto i = first_not_increasing(depth)) {
    table.problem("depth_m", "must increase: value number " + std::to_string(*i + 1) + " does not");
  } else if (depth.front() > 0.0 || depth.back() < sea_floor.value) {
    table.problem("depth_m", "must reach from 0 to seabed.depth_m");
  }
  return profile;
}

SoundSpeedProfile read_water(TableReader table, Meters sea_floor) {
  if (table.choice("profile", {"munk", "table"}) == 0) return read_munk(table);
  return read_table(table, sea_floor);
}

SedimentLayer read_layer(TableReader table, bool is_last) {
  SedimentLayer layer{.thickness = Meters{},
                      .sound_speed = MetersPerSecond{table.number("sound_speed_mps", kSoundSpeed)},
                      .density_g_per_cm3 = table.number_or("density_g_per_cm3", 1.5, Range::between(0.5, 20.0)),
                      .attenuation_db_per_wavelength = table.number_or("attenuation_db_per_wavelength", 0.5, Range::between(0.0, 20.0))};
  if (!is_last) layer.thickness = Meters{table.number("thickness_m", Range::above_up_to(0.0, kMaxDepth_m))};
  if (is_last && table.has("thickness_m")) {
    (void)table.number("thickness_m");
    table.problem("thickness_m", "must be left out of the last layer, which is a half-space");
  }
  return layer;
}

Seabed read_seabed(TableReader table) {
  Seabed seabed{.depth = Meters{table.number("depth_m", Range::above_up_to(0.0, kMaxDepth_m))}, .layers = {}};
  const std::vector<TableReader> layers = table.tables("layers");
  for (std::size_t i = 0; i < layers.size(); ++i) seabed.layers.push_back(read_layer(layers[i], i + 1 == layers.size()));
  if (table.has("layers") && layers.empty()) table.problem("layers", "must hold at least one layer");
  return seabed;
}

}  // namespace

Environment load_environment(const std::filesystem::path& path) {
  const config_file::File file(path);
  TableReader root = file.root();
  TableReader source = root.table("source");
  Environment environment{.name = root.text("name"),
                          .water = {},
                          .seabed = read_seabed(root.table("seabed")),
                          .source = read_source(source),
                          .noise_level = Decibels{root.table("noise").number("level_db_re_1upa", Range::between(-100.0, 300.0))},
                          .file_crc32 = crc32_of(path)};
  environment.water = read_water(root.table("water"), environment.seabed.depth);
  if (!(environment.source.depth < environment.seabed.depth)) {
    source.problem("depth_m", "must be less than seabed.depth_m");
  }
  file.finish();
  return environment;
}

}  // namespace earshot::ocean
