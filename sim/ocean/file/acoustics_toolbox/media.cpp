#include "sim/ocean/file/acoustics_toolbox/media.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "firmware/host/text/numbers.hpp"
#include "sim/ocean/file/acoustics_toolbox/interpolated.hpp"
#include "sim/ocean/water/sea_water.hpp"

namespace earshot::ocean::acoustics_toolbox {
namespace {

using host::Range;

constexpr std::size_t kMostPoints = 20'001;  // as many as the Acoustics Toolbox
constexpr double kMaxDepth_m = 12'000.0;
constexpr double kSameDepth_m = 1e-4;

const Range kSoundSpeed_mps = Range::between(300.0, 8000.0);
const Range kDensity_g_per_cm3 = Range::between(0.1, 20.0);
const Range kAttenuation_db_per_wavelength = Range::between(0.0, 20.0);

double density_of_water(const ListReader& file, const Medium& water) {
  const double density = water.front().density_g_per_cm3;
  const auto other = std::find_if(water.begin(), water.end(), [density](const FluidPoint& p) { return p.density_g_per_cm3 != density; });
  if (other != water.end())
    throw host::BadInput(file.path().string() + ": density of the water = " + host::shortest(other->density_g_per_cm3) + " at " +
                         host::shortest(other->depth_m) + " m: must be the same at all depths");
  return density;
}

/// The one absorption of sea water at all depths.
double absorption_of_water(const ListReader& file, const Medium& water, const TopOptions& options, Hertz frequency) {
  constexpr double kMostSpread = 0.1;
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const FluidPoint& point : water) {
    const double db_per_km = 1000.0 * point.attenuation_db_per_wavelength * frequency.value / point.sound_speed_mps;
    least = std::min(least, db_per_km);
    most = std::max(most, db_per_km);
  }
  if (most - least > kMostSpread * most)
    throw host::BadInput(file.path().string() + ": attenuation of the water = " + host::shortest(least) + " to " + host::shortest(most) +
                         " dB/km: must be the same at all depths, to a tenth");
  double absorption = 0.5 * (least + most);
  if (options.volume == VolumeAttenuation::kThorp) absorption += thorp_db_per_km(frequency);
  if (options.water) absorption += absorption_db_per_km(options.water->water, options.water->depth, frequency);
  return absorption;
}

/// Of the points on both sides of a layer.
SedimentLayer layer_between(const FluidPoint& top, const FluidPoint& base, double water_density_g_per_cm3) {
  SedimentLayer layer = half_space_layer(top, water_density_g_per_cm3);
  layer.thickness = Meters{base.depth_m - top.depth_m};
  if (base.sound_speed_mps != top.sound_speed_mps) layer.sound_speed_at_base = MetersPerSecond{base.sound_speed_mps};
  if (base.density_g_per_cm3 != top.density_g_per_cm3) layer.density_at_base_g_per_cm3 = base.density_g_per_cm3 / water_density_g_per_cm3;
  if (base.attenuation_db_per_wavelength != top.attenuation_db_per_wavelength)
    layer.attenuation_at_base_db_per_wavelength = base.attenuation_db_per_wavelength;
  return layer;
}

void require_linear(const ListReader& file, const FluidPoint& top, const FluidPoint& base, Interpolation interpolation) {
  if (interpolation == Interpolation::kLinear || top.sound_speed_mps == base.sound_speed_mps) return;
  throw host::BadInput(file.path().string() + ": sound speed of the sediment from " + host::shortest(top.depth_m) + " to " +
                       host::shortest(base.depth_m) + " m changes with depth: the first of the top options must be C then");
}

}  // namespace

FluidPoint FluidLines::fluid(std::array<double, 6> line) const {
  const auto [depth_m, speed_mps, shear_mps, density, attenuation, shear_attenuation] = line;
  file_.require("sound speed in m/s", speed_mps, kSoundSpeed_mps);
  if (shear_mps != 0.0) throw file_.error("shear speed in m/s", shear_mps, "must be 0: only fluid media are computed");
  file_.require("density in g/cm3", density, kDensity_g_per_cm3);
  file_.require("attenuation", attenuation, Range::at_least(0.0));
  const double per_wavelength = decibels_per_wavelength(attenuation, options_.unit, frequency_, MetersPerSecond{speed_mps});
  file_.require("attenuation in dB per wavelength", per_wavelength, kAttenuation_db_per_wavelength);
  return {.depth_m = depth_m, .sound_speed_mps = speed_mps, .density_g_per_cm3 = density, .attenuation_db_per_wavelength = per_wavelength};
}

FluidPoint FluidLines::next(const std::string& what) {
  file_.numbers(line_, what);
  return fluid(line_);
}

Medium FluidLines::medium(double top_m, double bottom_m) {
  Medium points;
  while (points.size() < kMostPoints) {
    line_[0] = std::numeric_limits<double>::quiet_NaN();
    const FluidPoint point = next("profile down to " + host::shortest(bottom_m) + " m");
    file_.require("depth in m", point.depth_m, Range::between(0.0, kMaxDepth_m));
    if (points.empty() && std::abs(point.depth_m - top_m) > kSameDepth_m)
      throw file_.error("depth in m", point.depth_m, "a medium must begin where the one above it ends, at " + host::shortest(top_m));
    if (!points.empty() && !(point.depth_m > points.back().depth_m))
      throw file_.error("depth in m", point.depth_m, "must be more than on the line before");
    if (point.depth_m > bottom_m + kSameDepth_m)
      throw file_.error("depth in m", point.depth_m, "a medium must end with a line of its own bottom, " + host::shortest(bottom_m));
    points.push_back(point);
    if (std::abs(point.depth_m - bottom_m) > kSameDepth_m) continue;
    if (points.size() < 2) throw file_.error("depth in m", point.depth_m, "a medium must have two points at least");
    return points;
  }
  throw file_.error("points of a profile", static_cast<double>(kMostPoints), "there must not be more, down to the bottom of its medium");
}

FluidPoint FluidLines::half_space() {
  line_[0] = 0.0;
  return next("the half-space");
}

SedimentLayer half_space_layer(const FluidPoint& fluid, double water_density_g_per_cm3) {
  return {.thickness = Meters{},
          .sound_speed = MetersPerSecond{fluid.sound_speed_mps},
          .density_g_per_cm3 = fluid.density_g_per_cm3 / water_density_g_per_cm3,
          .attenuation_db_per_wavelength = fluid.attenuation_db_per_wavelength};
}

Fluids fluids_of(const ListReader& file, const std::vector<Medium>& media, const FluidPoint& half_space, const TopOptions& options,
                 Hertz frequency) {
  const Medium& water = media.front();
  TabulatedProfile profile;
  for (const FluidPoint& point : water) {
    profile.depth_m.push_back(point.depth_m);
    profile.sound_speed_mps.push_back(point.sound_speed_mps);
  }
  Fluids fluids{.water = interpolated(profile, options.interpolation),
                .absorption_db_per_km = absorption_of_water(file, water, options, frequency),
                .sediment = {},
                .water_density_g_per_cm3 = density_of_water(file, water)};
  for (std::size_t i = 1; i < media.size(); ++i) {
    for (std::size_t j = 1; j < media[i].size(); ++j) {
      require_linear(file, media[i][j - 1], media[i][j], options.interpolation);
      fluids.sediment.push_back(layer_between(media[i][j - 1], media[i][j], fluids.water_density_g_per_cm3));
    }
  }
  fluids.sediment.push_back(half_space_layer(half_space, fluids.water_density_g_per_cm3));
  return fluids;
}

}  // namespace earshot::ocean::acoustics_toolbox
