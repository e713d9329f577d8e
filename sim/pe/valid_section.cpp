#include "sim/pe/valid_section.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>

#include "sim/pe/sediment_points.hpp"

namespace earshot::pe {

namespace {

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

template <class Station>
void require_increasing_ranges(const std::vector<Station>& stations, const std::string& what) {
  if (stations.empty()) throw std::invalid_argument(what + ": there is none, at least one is needed, at range 0 m");
  if (!(stations.front().range.value == 0.0)) refuse(what + ": its first range in m", stations.front().range.value, "0");
  for (std::size_t i = 1; i < stations.size(); ++i) {
    if (!(stations[i].range > stations[i - 1].range && std::isfinite(stations[i].range.value)))
      refuse(what + ": range " + std::to_string(i) + " in m", stations[i].range.value, "more than the one before");
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

void require_valid(const ocean::Section& section, Meters source_depth) {
  require_increasing_ranges(section.sea_floor, "bathymetry");
  require_increasing_ranges(section.water, "sound speed");
  require_increasing_ranges(section.sediment, "sediment");
  for (const ocean::SeaFloorStation& station : section.sea_floor) {
    if (!(station.depth.value >= 0.0 && station.depth.value <= kDeepest)) {
      std::ostringstream where;
      where << "bathymetry at " << station.range.value << " m: depth in m, positive down,";
      refuse(where.str(), station.depth.value, "0 (the surface) to 12000");
    }
  }
  for (const ocean::WaterStation& station : section.water)
    require_valid_profile(station.profile, "sound speed at range " + std::to_string(station.range.value) + " m",
                          ocean::sea_floor_depth(section, station.range).value);
  for (const ocean::SedimentStation& station : section.sediment) require_valid_sediment(sediment_points(station.layers));
  require_between("water attenuation in dB/km", section.absorption_db_per_km, 0.0, 1000.0);
  const Meters at_source = section.sea_floor.front().depth;
  if (!(source_depth.value > 0.0 && source_depth < at_source)) {
    std::ostringstream allowed;
    allowed << "in the water, between 0 and " << at_source.value;
    refuse("source depth in m", source_depth.value, allowed.str());
  }
}

}  // namespace earshot::pe
