#include "sim/pe/section.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>

#include "sim/ocean/section.hpp"

namespace earshot::pe {

namespace {

/// Index of the last element that begins at or before a range; the first when none does.
template <class Column>
std::size_t last_before(const std::vector<Column>& columns, double range_m) {
  const auto after = std::upper_bound(columns.begin(), columns.end(), range_m, [](double r, const Column& c) { return r < c.range_m; });
  return after == columns.begin() ? 0 : static_cast<std::size_t>(after - columns.begin()) - 1;
}

[[noreturn]] void refuse(const std::string& what, double value, const std::string& allowed) {
  std::ostringstream text;
  text << what << " is " << value << ", allowed: " << allowed;
  throw std::invalid_argument(text.str());
}

void require_between(const std::string& what, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    std::ostringstream allowed;
    allowed << low << " to " << high;
    refuse(what, value, allowed.str());
  }
}

template <class Column>
void require_increasing_ranges(const std::vector<Column>& columns, const std::string& what) {
  if (columns.empty()) throw std::invalid_argument(what + ": there is none, at least one is needed, at range 0 m");
  if (!(columns.front().range_m == 0.0)) refuse(what + ": its first range in m", columns.front().range_m, "0");
  for (std::size_t i = 1; i < columns.size(); ++i) {
    if (!(columns[i].range_m > columns[i - 1].range_m && std::isfinite(columns[i].range_m)))
      refuse(what + ": range " + std::to_string(i) + " in m", columns[i].range_m, "more than the one before");
  }
}

constexpr double kSlowest = 300.0;  // m/s: gassy mud
constexpr double kFastest = 8000.0;
constexpr double kDeepest = 12'000.0;  // m

void require_valid_profile(const ocean::SoundSpeedProfile& profile, const std::string& where, double floor_depth_m) {
  if (const auto* table = std::get_if<ocean::TabulatedProfile>(&profile)) {
    if (table->depth_m.empty() || table->depth_m.size() != table->sound_speed_mps.size())
      throw std::invalid_argument(where + ": needs as many sound speeds as depths, at least one");
    for (std::size_t i = 0; i < table->depth_m.size(); ++i) {
      require_between(where + ": sound speed in m/s", table->sound_speed_mps[i], kSlowest, kFastest);
      if (!std::isfinite(table->depth_m[i]) || (i > 0 && !(table->depth_m[i] > table->depth_m[i - 1])))
        refuse(where + ": depth " + std::to_string(i) + " in m", table->depth_m[i], "finite and more than the one before");
    }
  }
  for (const double depth : {0.0, 0.5 * floor_depth_m, floor_depth_m})
    require_between(where + ": sound speed in m/s", ocean::sound_speed(profile, Meters{depth}).value, kSlowest, kFastest);
}

void require_valid_sediment(const std::vector<SedimentPoint>& points) {
  if (points.empty()) throw std::invalid_argument("sediment: there is no layer, at least a half-space is needed");
  double deepest = 0.0;
  for (const SedimentPoint& point : points) {
    require_between("sediment: depth below the sea floor in m (increasing)", point.depth_below_floor_m, deepest, kDeepest);
    require_between("sediment: sound speed in m/s", point.sound_speed_mps, kSlowest, kFastest);
    require_between("sediment: density in g/cm3", point.density_g_per_cm3, 0.1, 20.0);
    require_between("sediment: attenuation in dB per wavelength", point.attenuation_db_per_wavelength, 0.0, 20.0);
    deepest = point.depth_below_floor_m;
  }
}

}  // namespace

double Section::floor_depth_m(double range_m) const {
  const std::size_t i = last_before(floor, range_m);
  if (i + 1 == floor.size() || range_m <= floor[i].range_m) return floor[i].depth_m;
  const double share = (range_m - floor[i].range_m) / (floor[i + 1].range_m - floor[i].range_m);
  return floor[i].depth_m + share * (floor[i + 1].depth_m - floor[i].depth_m);
}

const SedimentColumn& Section::sediment_at(double range_m) const {
  return sediment[last_before(sediment, range_m)];
}

double Section::water_sound_speed_mps(double range_m, double depth_m) const {
  const std::size_t i = last_before(water, range_m);
  const double here = ocean::sound_speed(water[i].profile, Meters{depth_m}).value;
  if (i + 1 == water.size() || range_m <= water[i].range_m) return here;
  const double there = ocean::sound_speed(water[i + 1].profile, Meters{depth_m}).value;
  return here + (there - here) * (range_m - water[i].range_m) / (water[i + 1].range_m - water[i].range_m);
}

std::vector<SedimentPoint> sediment_points(const std::vector<ocean::SedimentLayer>& layers) {
  std::vector<SedimentPoint> points;
  double top = 0.0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const ocean::SedimentLayer& layer = layers[i];
    points.push_back({top, layer.sound_speed.value, layer.density_g_per_cm3, layer.attenuation_db_per_wavelength});
    if (i + 1 == layers.size()) break;
    top += layer.thickness.value;
    points.push_back({top, layer.sound_speed_at_base.value_or(layer.sound_speed).value,
                      layer.density_at_base_g_per_cm3.value_or(layer.density_g_per_cm3),
                      layer.attenuation_at_base_db_per_wavelength.value_or(layer.attenuation_db_per_wavelength)});
  }
  return points;
}

Section make_section(const ocean::Environment& environment) {
  if (!ocean::is_range_independent(environment)) {
    throw std::invalid_argument(environment.name + ": its ocean changes with range or bearing; a radial of it must be named");
  }
  return {.floor = {{0.0, environment.seabed.depth.value}},
          .water = {{0.0, environment.water}},
          .sediment = {{0.0, sediment_points(environment.seabed.layers)}},
          .water_attenuation_db_per_km = environment.absorption_db_per_km};
}

void require_valid(const Section& section, Meters source_depth) {
  require_increasing_ranges(section.floor, "bathymetry");
  require_increasing_ranges(section.water, "sound speed");
  require_increasing_ranges(section.sediment, "sediment");
  for (const FloorPoint& point : section.floor) {
    if (!(point.depth_m >= 0.0 && point.depth_m <= kDeepest)) {
      std::ostringstream where;
      where << "bathymetry at " << point.range_m << " m: depth in m, positive down,";
      refuse(where.str(), point.depth_m, "0 (the surface) to 12000");
    }
  }
  for (const WaterColumn& column : section.water)
    require_valid_profile(column.profile, "sound speed at range " + std::to_string(column.range_m) + " m",
                          section.floor_depth_m(column.range_m));
  for (const SedimentColumn& column : section.sediment) require_valid_sediment(column.points);
  require_between("water attenuation in dB/km", section.water_attenuation_db_per_km, 0.0, 1000.0);
  if (!(source_depth.value > 0.0 && source_depth.value < section.floor.front().depth_m)) {
    std::ostringstream allowed;
    allowed << "in the water, between 0 and " << section.floor.front().depth_m;
    refuse("source depth in m", source_depth.value, allowed.str());
  }
}

}  // namespace earshot::pe
