#include "sim/ocean/file/environment_file.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/host/file/file_checksum.hpp"
#include "sim/ocean/charts/charts.hpp"
#include "sim/ocean/file/bathymetry_csv.hpp"
#include "sim/ocean/section_along.hpp"

namespace earshot::ocean {
namespace {

using host::BadInput;

std::uint32_t crc32_of(const std::vector<double>& values, std::uint32_t previous) {
  return crc32({reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(double)}, previous);
}

std::uint32_t crc32_of(const GeoAxes& axes, std::uint32_t previous) {
  return crc32_of(axes.longitude_deg, crc32_of(axes.latitude_deg, previous));
}

/// The water that data gives; CRC of the data goes on from `crc`, and its files join those of the environment.
void take_water(Environment& environment, Charts& charts, const EnvironmentKeys& keys, std::uint32_t& crc) {
  if (const auto* csv = std::get_if<WaterCsv>(&keys.water)) {
    const double latitude_deg = keys.origin ? keys.origin->latitude_deg : 45.0;
    auto stations = read_profile_csv(csv->file, Radians{latitude_deg * std::numbers::pi / 180.0}, csv->formula);
    environment.water = stations.front().profile;
    if (stations.size() > 1) environment.water_stations = std::move(stations);
    crc = host::crc32_of_file(csv->file, crc);
    environment.files.push_back(csv->file);
  } else if (const auto* atlas = std::get_if<WaterAtlas>(&keys.water)) {
    charts.climatology = read_world_ocean_atlas(atlas->files, *keys.origin, atlas->reach);
    charts.formula = atlas->formula;
    environment.files.push_back(atlas->files.temperature);
    environment.files.push_back(atlas->files.salinity);
    crc = crc32_of(charts.climatology->depth_m, crc32_of(charts.climatology->axes, crc));
    crc = crc32_of(charts.climatology->salinity_psu, crc32_of(charts.climatology->temperature_c, crc));
  }
}

void take_sea_floor(Environment& environment, Charts& charts, const EnvironmentKeys& keys, std::uint32_t& crc) {
  if (!keys.bathymetry) return;
  const BathymetryKeys& from = *keys.bathymetry;
  if (from.layout == BathymetryLayout::kSection) {
    environment.sea_floor_stations = from.section;
    return;
  }
  environment.files.push_back(from.file);
  switch (from.layout) {
    case BathymetryLayout::kSection:  // above
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
      fail("the last depth_m of the sound-speed profile", table->depth_m.back(), "must extend to the deepest sea floor", needed_m);
    }
  };
  check(environment.water);
  for (const WaterStation& station : environment.water_stations) check(station.profile);
}

/// @param crc    of the text that the keys were read from
/// @param files  that it stands in
Environment environment_of(const std::filesystem::path& path, const EnvironmentKeys& keys, std::uint32_t crc,
                           std::vector<std::filesystem::path> files) {
  Environment environment = keys.environment;
  environment.files = std::move(files);
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

Environment environment_of(const std::filesystem::path& path, const EnvironmentKeys& keys) {
  return environment_of(path, keys, host::crc32_of_file(path), {path});
}

Environment environment_of_text(const std::string& name, const std::string& text) {
  const std::uint32_t crc = crc32({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, 0);
  return environment_of(name, read_environment_keys(host::TomlFile(name, text)), crc, {});
}

Environment load_environment(const std::filesystem::path& path) {
  return environment_of(path, read_environment_keys(host::TomlFile(path)));
}

}  // namespace earshot::ocean
