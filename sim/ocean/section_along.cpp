#include "sim/ocean/section_along.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "sim/ocean/charts/charts.hpp"
#include "sim/ocean/stations.hpp"

namespace earshot::ocean {
namespace {

/// Ranges from 0 to `max_range`, evenly, at most `step` apart.
std::vector<double> even_ranges(Meters max_range, Meters step) {
  const auto intervals = static_cast<std::size_t>(std::max(1.0, std::ceil(max_range / step)));
  std::vector<double> range_m;
  for (std::size_t i = 0; i <= intervals; ++i) {
    range_m.push_back(max_range.value * static_cast<double>(i) / static_cast<double>(intervals));
  }
  return range_m;
}

struct Radial {
  GeoPosition from;
  Radians azimuth;
  Meters max_range;
};

Radial radial_in(const LocalGrid& grid, NorthEast from, Radians bearing, Meters max_range) {
  const UnitNorthEast direction{.north = std::cos(bearing.value), .east = std::sin(bearing.value)};
  const GeoPosition start = grid.to_geographic(from);
  const GeoPosition end = grid.to_geographic(from + max_range * direction);
  return {.from = start, .azimuth = geodesic_between(start, end).azimuth, .max_range = max_range};
}

void take_sea_floor(Section& section, const Bathymetry& chart, const Radial& radial) {
  const std::vector<double> range_m = even_ranges(radial.max_range, 0.5 * spacing(chart.axes));
  const std::vector<GeoPosition> positions = geodesic_radial(radial.from, radial.azimuth, range_m);
  section.sea_floor.clear();
  for (std::size_t i = 0; i < range_m.size(); ++i) {
    const Meters range{range_m[i]};
    const Meters depth = sea_floor_depth(chart, positions[i]);
    if (depth > Meters{}) {
      section.sea_floor.push_back({.range = range, .depth = depth});
      continue;
    }
    if (i == 0) {
      std::ostringstream text;
      text << chart.file << ": latitude " << radial.from.latitude_deg << ", longitude " << radial.from.longitude_deg << " is on land, "
           << -depth.value << " m above the sea surface; a radial must begin in the water";
      throw host::BadInput(text.str());
    }
    const SeaFloorStation& last = section.sea_floor.back();
    section.shore = mix(last.range, range, last.depth / (last.depth - depth));
    section.sea_floor.push_back({.range = *section.shore, .depth = Meters{}});
    return;
  }
}

/// At every station of the sea floor as far as the radial goes, and of the water.
/// @param data_end  at each station of the water; between two of them the shallower counts
void note_unmeasured(Section& section, const std::vector<Meters>& data_end, const std::string& file, Meters max_range) {
  constexpr double kMostBeyond = 1.1;
  std::vector<Meters> ranges;
  for (const SeaFloorStation& station : section.sea_floor) ranges.push_back(station.range);
  for (const WaterStation& station : section.water) ranges.push_back(station.range);
  for (const Meters range : ranges) {
    if (range > section.shore.value_or(max_range)) continue;
    const Between at = stations_about(section.water, range);
    const UnmeasuredWater here{.file = file,
                               .range = range,
                               .data_end = std::min(data_end[at.below], data_end[at.above]),
                               .sea_floor = sea_floor_depth(section, range)};
    if (here.sea_floor > kMostBeyond * here.data_end && (!section.unmeasured || here.thickness() > section.unmeasured->thickness()))
      section.unmeasured = here;
  }
}

void take_water(Section& section, const Climatology& chart, SoundSpeedFormula formula, const Radial& radial) {
  const Radial afloat{radial.from, radial.azimuth, section.shore.value_or(radial.max_range)};
  const std::vector<double> range_m = even_ranges(afloat.max_range, 0.5 * spacing(chart.axes));
  const std::vector<GeoPosition> positions = geodesic_radial(afloat.from, afloat.azimuth, range_m);
  section.water.clear();
  std::vector<Meters> data_end;
  for (std::size_t i = 0; i < range_m.size(); ++i) {
    section.water.push_back({.range = Meters{range_m[i]}, .profile = profile_at(chart, positions[i], formula)});
    data_end.push_back(data_end_at(chart, positions[i]));
  }
  note_unmeasured(section, data_end, chart.file, radial.max_range);
}

/// Sea floor and water are constant up to their first station: one more says so. Sediment holds backwards by moving its first.
void begin_at_source(Section& section) {
  if (section.sea_floor.front().range > Meters{}) {
    section.sea_floor.insert(section.sea_floor.begin(), {.range = Meters{}, .depth = section.sea_floor.front().depth});
  }
  if (section.water.front().range > Meters{}) {
    section.water.insert(section.water.begin(), {.range = Meters{}, .profile = section.water.front().profile});
  }
  section.sediment.front().range = Meters{};
}

}  // namespace

bool is_range_independent(const Environment& environment) {
  const bool charted = environment.charts != nullptr && (environment.charts->bathymetry || environment.charts->climatology);
  return !charted && environment.water_stations.size() < 2 && environment.sea_floor_stations.size() < 2 &&
         environment.sediment_stations.size() < 2;
}

Section section_along(const Environment& environment, NorthEast from, Radians bearing, Meters max_range) {
  Section section{.water = environment.water_stations,
                  .sea_floor = environment.sea_floor_stations,
                  .sediment = environment.sediment_stations,
                  .absorption_db_per_km = environment.absorption_db_per_km};
  if (section.water.empty()) section.water.push_back({.range = Meters{}, .profile = environment.water});
  if (section.sea_floor.empty()) section.sea_floor.push_back({.range = Meters{}, .depth = environment.seabed.depth});
  if (section.sediment.empty()) section.sediment.push_back({.range = Meters{}, .layers = environment.seabed.layers});
  if (section.sea_floor.back().depth == Meters{}) section.shore = section.sea_floor.back().range;
  if (environment.charts != nullptr) {
    const Charts& charts = *environment.charts;
    const Radial radial = radial_in(charts.grid, from, bearing, max_range);
    if (charts.bathymetry) take_sea_floor(section, *charts.bathymetry, radial);
    if (charts.climatology) take_water(section, *charts.climatology, charts.formula, radial);
  }
  begin_at_source(section);
  return section;
}

}  // namespace earshot::ocean
