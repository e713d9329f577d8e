#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "sim/ocean/charts/charts.hpp"
#include "sim/ocean/environment.hpp"

namespace earshot::tests {

/// A degree of the equator on the WGS 84 ellipsoid.
inline constexpr Meters kDegreeOfTheEquator{111'319.4908};

/// An ocean about latitude 0, longitude 0 that is 3000 m deep and 1000 m deeper for every degree east, with temperature and salinity of 4
/// degC and 35 psu measured down to 1500 m.
inline ocean::Environment charted_ocean() {
  auto charts = std::make_shared<ocean::Charts>();
  const ocean::GeoAxes axes{.centre_longitude_deg = 0.0, .latitude_deg = {-1.0, 0.0, 1.0}, .longitude_deg = {-1.0, 0.0, 1.0}};
  charts->bathymetry =
      ocean::Bathymetry{.file = "chart.nc", .axes = axes, .elevation_m = {-2000, -3000, -4000, -2000, -3000, -4000, -2000, -3000, -4000}};
  charts->climatology = ocean::Climatology{.file = "woa.nc",
                                           .axes = axes,
                                           .depth_m = {0.0, 1500.0},
                                           .temperature_c = std::vector<double>(18, 4.0),
                                           .salinity_psu = std::vector<double>(18, 35.0)};
  ocean::Environment sea{.name = "charted",
                         .water = ocean::TabulatedProfile{{0.0}, {1500.0}},
                         .seabed = {.depth = Meters{3000.0}, .layers = {{.thickness = Meters{}, .sound_speed = MetersPerSecond{1600.0}}}},
                         .source = {},
                         .noise_level = {}};
  sea.charts = std::move(charts);
  return sea;
}

}  // namespace earshot::tests
