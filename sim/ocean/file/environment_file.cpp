#include "sim/ocean/file/environment_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/host/file/file_checksum.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "sim/ocean/charts/charts.hpp"
#include "sim/ocean/environment_conditions.hpp"
#include "sim/ocean/environment_family.hpp"
#include "sim/ocean/file/bathymetry_csv.hpp"
#include "sim/ocean/file/environment_noise.hpp"
#include "sim/ocean/file/environment_seabed.hpp"
#include "sim/ocean/file/environment_water.hpp"
#include "sim/ocean/section.hpp"

namespace earshot::ocean {
namespace {

using host::BadInput;
using host::Range;
using host::TableReader;

constexpr double kMaxDepth_m = 12'000.0;  // deeper than any ocean: whoever exceeds it has mistaken the unit

constexpr double kFurthest_m = 1e6;  // from the origin: a plane further out than that is none on this earth

enum class BathymetryLayout : std::uint8_t { kSectionCsv, kGridCsv, kGebco };

struct BathymetryKeys {
  BathymetryLayout layout;
  std::filesystem::path file;
  Meters reach;
};

/// What the file itself says, before the data files it names are read.
struct Keys {
  std::string name;
  Source source;
  Decibels noise_level;
  double absorption_db_per_km = 0.0;
  std::optional<GeoPosition> origin;
  WaterKeys water;
  SeabedKeys seabed;
  std::optional<BathymetryKeys> bathymetry;
  Conditions conditions;
  std::vector<std::filesystem::path> other_oceans;
  std::optional<Family> family;
  std::filesystem::path field_library;

  [[nodiscard]] bool is_one_ocean() const { return other_oceans.empty() && !family && field_library.empty() && is_calm(conditions); }
};

/// Another checksum, lowest byte first.
std::uint32_t crc32_of(std::uint32_t checksum, std::uint32_t previous) {
  std::array<std::uint8_t, 4> bytes{};
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(checksum);
    checksum >>= 8U;
  }
  return crc32(bytes, previous);
}

std::uint32_t crc32_of(const std::vector<double>& values, std::uint32_t previous) {
  return crc32({reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(double)}, previous);
}

std::uint32_t crc32_of(const GeoAxes& axes, std::uint32_t previous) {
  return crc32_of(axes.longitude_deg, crc32_of(axes.latitude_deg, previous));
}

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

BathymetryKeys read_bathymetry(const host::TomlFile& file, TableReader table) {
  BathymetryKeys keys{.layout = static_cast<BathymetryLayout>(table.choice("layout", {"section_csv", "grid_csv", "gebco"})),
                      .file = file.resolve(table.text("file")),
                      .reach = {}};
  if (keys.layout == BathymetryLayout::kGebco) {
    keys.reach = Meters{1000.0 * table.number_or("reach_km", 150.0, Range::above_up_to(0.0, 5000.0))};
  }
  return keys;
}

/// Tables of depths reach as deep as a flat sea floor.
void check_reach(TableReader& water, const Keys& keys) {
  const auto is_short = [&](const SoundSpeedProfile& profile) {
    const auto* table = std::get_if<TabulatedProfile>(&profile);
    return table != nullptr && !table->depth_m.empty() && table->depth_m.back() < keys.seabed.seabed.depth.value;
  };
  const auto& stations = keys.water.stations;
  if (is_short(keys.water.profile) || std::any_of(stations.begin(), stations.end(), [&](const auto& s) { return is_short(s.profile); })) {
    water.problem("depth_m", "must reach from 0 to seabed.depth_m");
  }
}

/// The family is drawn from the file's own ocean, which must have the numbers that are drawn.
Family read_own_family(TableReader table, const Keys& keys) {
  Family family = read_family(table);
  const bool plain = keys.water.from == WaterSource::kKeys && std::holds_alternative<MunkProfile>(keys.water.profile) && !keys.bathymetry &&
                     keys.seabed.stations.empty();
  if (!plain)
    table.problem("members", "are drawn from an ocean with a Munk profile, flat and the same everywhere; list others as [[oceans]]");
  if (plain && !(std::get<MunkProfile>(keys.water.profile).axis_depth.value > 0.0)) {
    table.problem("members", "are drawn from an ocean whose water.axis_depth_m is above 0: their scale keeps its ratio to it");
  }
  if (family.sea_floor_depth_m && !(family.sea_floor_depth_m->lowest > keys.source.depth.value)) {
    table.problem("sea_floor_depth_m", "must be more than source.depth_m");
  }
  return family;
}

/// What a search meets besides this one ocean.
void read_search_keys(const host::TomlFile& file, TableReader& root, Keys& keys) {
  if (const auto conditions = root.optional_table("conditions")) keys.conditions = read_conditions(*conditions);
  if (const auto family = root.optional_table("family")) keys.family = read_own_family(*family, keys);
  if (root.has("oceans")) {
    for (TableReader& ocean : root.tables("oceans")) keys.other_oceans.push_back(file.resolve(ocean.text("environment")));
  }
  if (auto library = root.optional_table("field_library")) keys.field_library = file.resolve(library->text("file"));
  if (!keys.field_library.empty() && (keys.family || !keys.other_oceans.empty())) {
    root.problem("field_library", "cannot be there with family or oceans");
  }
}

Keys read_keys(const host::TomlFile& file) {
  TableReader root = file.root();
  TableReader source = root.table("source");
  TableReader water = root.table("water");
  Keys keys{.name = root.text("name"),
            .source = read_source(source),
            .noise_level = read_noise(root.table("noise")),
            .origin = {},
            .water = read_water(file, water),
            .seabed = {},
            .bathymetry = {},
            .conditions = {},
            .other_oceans = {},
            .family = {},
            .field_library = {}};
  if (const auto origin = root.optional_table("origin")) keys.origin = read_origin(*origin);
  if (const auto absorption = root.optional_table("absorption")) {
    keys.absorption_db_per_km = read_absorption(*absorption, keys.source.frequency);
  }
  if (const auto bathymetry = root.optional_table("bathymetry")) keys.bathymetry = read_bathymetry(file, *bathymetry);
  keys.seabed = read_seabed(root.table("seabed"), keys.bathymetry ? SeaFloorDepth::kGivenByBathymetry : SeaFloorDepth::kGivenHere);
  read_search_keys(file, root, keys);
  const bool chart = keys.bathymetry && keys.bathymetry->layout != BathymetryLayout::kSectionCsv;
  if (!keys.origin && (chart || keys.water.from == WaterSource::kAtlas)) {
    root.problem("origin", "must be there, with latitude_deg and longitude_deg: where north_m = 0, east_m = 0 lies on the charts");
  }
  file.finish();
  if (!keys.bathymetry) {  // how values that are right by themselves fit each other
    check_reach(water, keys);
    if (!(keys.source.depth < keys.seabed.seabed.depth)) source.problem("depth_m", "must be less than seabed.depth_m");
  }
  file.finish();
  return keys;
}

/// The water, from wherever it comes; CRC of the data goes on from `crc`.
void take_water(Environment& environment, Charts& charts, const Keys& keys, std::uint32_t& crc) {
  environment.water = keys.water.profile;
  environment.water_stations = keys.water.stations;
  if (keys.water.from == WaterSource::kCsv) {
    const double latitude_deg = keys.origin ? keys.origin->latitude_deg : 45.0;
    auto stations = read_profile_csv(keys.water.csv, Radians{latitude_deg * std::numbers::pi / 180.0}, keys.water.formula);
    environment.water = stations.front().profile;
    if (stations.size() > 1) environment.water_stations = std::move(stations);
    crc = host::crc32_of_file(keys.water.csv, crc);
  } else if (keys.water.from == WaterSource::kAtlas) {
    charts.climatology = read_world_ocean_atlas(keys.water.atlas, *keys.origin, keys.water.reach);
    charts.formula = keys.water.formula;
    crc = crc32_of(charts.climatology->depth_m, crc32_of(charts.climatology->axes, crc));
    crc = crc32_of(charts.climatology->salinity_psu, crc32_of(charts.climatology->temperature_c, crc));
  }
}

void take_sea_floor(Environment& environment, Charts& charts, const Keys& keys, std::uint32_t& crc) {
  if (!keys.bathymetry) return;
  const BathymetryKeys& from = *keys.bathymetry;
  switch (from.layout) {
    case BathymetryLayout::kSectionCsv:
      environment.sea_floor_stations = read_section_csv(from.file);
      crc = host::crc32_of_file(from.file, crc);
      return;
    case BathymetryLayout::kGridCsv:
      charts.bathymetry = read_bathymetry_csv(from.file, *keys.origin);
      break;
    case BathymetryLayout::kGebco:
      charts.bathymetry = read_gebco(from.file, *keys.origin, from.reach);
      break;
  }
  crc = crc32_of(charts.bathymetry->elevation_m, crc32_of(charts.bathymetry->axes, crc));
}

Meters deepest(const Environment& environment, const Charts& charts) {
  Meters depth = environment.seabed.depth;
  for (const SeaFloorStation& station : environment.sea_floor_stations) depth = std::max(depth, station.depth);
  if (charts.bathymetry) {
    for (const double elevation_m : charts.bathymetry->elevation_m) depth = std::max(depth, Meters{-elevation_m});
  }
  return depth;
}

/// What could not be checked before the sea floor was known.
void check_against_data(const std::filesystem::path& path, const Environment& environment, const Charts& charts) {
  const auto fail = [&](const std::string& key, double value, const std::string& must, double limit_m) {
    std::ostringstream text;
    text << path.string() << ": " << key << " = " << value << ": " << must << ", " << limit_m << " m";
    throw BadInput(text.str());
  };
  const Meters floor = environment.seabed.depth;
  if (!(environment.source.depth < floor)) {
    fail("source.depth_m", environment.source.depth.value, "must be less than the depth of the sea floor at the source", floor.value);
  }
  const double needed_m = deepest(environment, charts).value;
  const auto check = [&](const SoundSpeedProfile& profile) {
    const auto* table = std::get_if<TabulatedProfile>(&profile);
    if (table != nullptr && table->depth_m.back() < needed_m) {
      fail("the last depth_m of the sound-speed profile", table->depth_m.back(), "must reach the deepest sea floor", needed_m);
    }
  };
  check(environment.water);
  for (const WaterStation& station : environment.water_stations) check(station.profile);
}

/// The file's own ocean.
Environment own_ocean(const std::filesystem::path& path, const Keys& keys) {
  std::uint32_t crc = host::crc32_of_file(path);
  Environment environment{.name = keys.name,
                          .water = {},
                          .seabed = keys.seabed.seabed,
                          .source = keys.source,
                          .noise_level = keys.noise_level,
                          .absorption_db_per_km = keys.absorption_db_per_km,
                          .sediment_stations = keys.seabed.stations,
                          .conditions = keys.conditions,
                          .field_library = keys.field_library};
  auto charts = std::make_shared<Charts>(Charts{.grid = {keys.origin.value_or(GeoPosition{})}, .bathymetry = {}, .climatology = {}});
  take_water(environment, *charts, keys, crc);
  take_sea_floor(environment, *charts, keys, crc);
  environment.file_crc32 = crc;
  if (keys.origin) environment.charts = charts;

  const Section at_source = section_along(environment, environment.source.position, Radians{}, Meters{1.0});
  environment.water = at_source.water.front().profile;
  environment.seabed.depth = at_source.sea_floor.front().depth;
  check_against_data(path, environment, *charts);
  return environment;
}

}  // namespace

Environment load_environment(const std::filesystem::path& path) {
  const Keys keys = read_keys(host::TomlFile(path));
  Environment environment = own_ocean(path, keys);
  if (keys.family) environment.other_oceans = draw_family(environment, *keys.family);
  if (std::filesystem::exists(keys.field_library))  // whoever needs it says when it is not there
    environment.file_crc32 = host::crc32_of_file(keys.field_library, environment.file_crc32);
  for (const std::filesystem::path& other : keys.other_oceans) {
    const Keys its_keys = read_keys(host::TomlFile(other));
    if (!its_keys.is_one_ocean()) throw BadInput(path.string() + ": oceans: " + other.string() + ": must be one ocean without conditions");
    environment.other_oceans.push_back(own_ocean(other, its_keys));
    environment.file_crc32 = crc32_of(environment.other_oceans.back().file_crc32, environment.file_crc32);
  }
  return environment;
}

}  // namespace earshot::ocean
