#include "sim/ocean/file/acoustics_toolbox/range_files.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "firmware/host/text/numbers.hpp"
#include "sim/ocean/stations.hpp"

namespace earshot::ocean::acoustics_toolbox {
namespace {

using host::Range;

constexpr std::size_t kMostFloorPoints = 100'000;
constexpr std::size_t kMostProfiles = 10'000;
constexpr std::size_t kMostSpeeds = 4'000'000;
const Range kRange_km = Range::between(-20'000.0, 20'000.0);
const Range kSoundSpeed_mps = Range::between(300.0, 8000.0);

/// Stations from range 0 on: what lies behind the source is left out, and what is found at the source stands at 0.
/// @param at  makes the station that is found at range 0
template <class Station, class At>
std::vector<Station> from_source(std::vector<Station> stations, const At& at) {
  if (!(stations.front().range < Meters{})) return stations;
  const Station here = at(stations_about(stations, Meters{}));
  std::erase_if(stations, [](const Station& station) { return !(station.range > Meters{}); });
  stations.insert(stations.begin(), here);
  return stations;
}

void require_increasing(const ListReader& file, const std::string& what, double value, double before) {
  if (!(value > before)) throw file.error(what, value, "must be more than the one before, " + host::shortest(before));
}

bool is_long(const ListReader& file, std::string type) {
  type.resize(std::max<std::size_t>(type.size(), 2), ' ');
  if (type[0] != 'L' && type[0] != 'C') throw file.error("type of bathymetry", type, "must begin with L or C");
  if (type[1] != 'S' && type[1] != 'L' && type[1] != ' ') throw file.error("type of bathymetry", type, "the second letter must be S or L");
  return type[1] == 'L';
}

SeaFloorStation read_point(ListReader& file, std::array<double, 7>& line, bool is_long, Meters deepest) {
  line[0] = line[1] = std::numeric_limits<double>::quiet_NaN();
  file.numbers({line.data(), is_long ? line.size() : 2U}, "a point of the sea floor");
  file.require("range in km", line[0], kRange_km);
  file.require("depth in m", line[1], Range::at_least(0.0));
  if (!(line[1] <= deepest.value))
    throw file.error("depth in m", line[1],
                     "must not be more than the depth that the profile of the water ends at, " + host::shortest(deepest.value));
  return {.range = Meters{1000.0 * line[0]}, .depth = Meters{line[1]}};
}

}  // namespace

Bathymetry read_bathymetry(const std::filesystem::path& path, Meters deepest, const TopOptions& options, Hertz frequency,
                           double water_density_g_per_cm3) {
  ListReader file(path);
  const FluidLines fluids(file, options, frequency);
  const bool has_sediment = is_long(file, file.text("type of bathymetry"));
  const std::size_t count = file.count("number of points", 1, kMostFloorPoints);
  Bathymetry result;
  std::array<double, 7> line{0.0, 0.0, 1500.0, 0.0, 1.0, 0.0, 0.0};
  for (std::size_t i = 0; i < count; ++i) {
    const SeaFloorStation point = read_point(file, line, has_sediment, deepest);
    if (i > 0) require_increasing(file, "range in km", line[0], result.sea_floor.back().range.value / 1000.0);
    if (!(point.depth > Meters{}) && i + 1 < count) throw file.error("depth in m", 0.0, "must be above 0, but for the last, a shore");
    result.sea_floor.push_back(point);
    if (!has_sediment) continue;
    const FluidPoint fluid = fluids.fluid({line[1], line[2], line[3], line[4], line[5], line[6]});
    result.sediment.push_back({.range = point.range, .layers = {half_space_layer(fluid, water_density_g_per_cm3)}});
  }
  const std::vector<SeaFloorStation>& floor = result.sea_floor;
  result.sea_floor = from_source(floor, [&floor](const Between& at) {
    return SeaFloorStation{.range = Meters{}, .depth = mix(floor[at.below].depth, floor[at.above].depth, at.fraction)};
  });
  if (!(result.sea_floor.front().depth > Meters{})) throw file.error("depth in m", 0.0, "must be above 0 at the source");
  const std::vector<SedimentStation>& sediment = result.sediment;
  if (has_sediment)
    result.sediment = from_source(
        sediment, [&sediment](const Between& at) { return SedimentStation{.range = Meters{}, .layers = sediment[at.below].layers}; });
  return result;
}

std::vector<WaterStation> read_water(const std::filesystem::path& path, const std::vector<double>& depth_m) {
  ListReader file(path);
  const std::size_t count = file.count("number of profiles", 2, std::min(kMostProfiles, kMostSpeeds / depth_m.size()));
  std::vector<double> range_km(count, std::numeric_limits<double>::quiet_NaN());
  file.numbers(range_km, "ranges of the profiles in km");
  std::vector<TabulatedProfile> profiles(count, TabulatedProfile{.depth_m = depth_m, .sound_speed_mps = {}});
  for (std::size_t i = 0; i < count; ++i) {
    file.require("ranges of the profiles in km", range_km[i], kRange_km);
    if (i > 0) require_increasing(file, "ranges of the profiles in km", range_km[i], range_km[i - 1]);
  }
  for (const double depth : depth_m) {
    std::vector<double> speed_mps(count, std::numeric_limits<double>::quiet_NaN());
    const std::string what = "sound speeds at " + host::shortest(depth) + " m";
    file.numbers(speed_mps, what);
    for (std::size_t i = 0; i < count; ++i) {
      file.require(what, speed_mps[i], kSoundSpeed_mps);
      profiles[i].sound_speed_mps.push_back(speed_mps[i]);
    }
  }
  std::vector<WaterStation> stations;
  for (std::size_t i = 0; i < count; ++i) stations.push_back({.range = Meters{1000.0 * range_km[i]}, .profile = profiles[i]});
  return from_source(std::move(stations), [&](const Between& at) {
    TabulatedProfile here = profiles[at.below];
    for (std::size_t i = 0; i < depth_m.size(); ++i)
      here.sound_speed_mps[i] = std::lerp(here.sound_speed_mps[i], profiles[at.above].sound_speed_mps[i], at.fraction);
    return WaterStation{.range = Meters{}, .profile = here};
  });
}

}  // namespace earshot::ocean::acoustics_toolbox
