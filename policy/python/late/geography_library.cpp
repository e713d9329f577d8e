#include "policy/python/late/geography_library.hpp"

#include <vector>

#include "sim/ocean/charts/geography.hpp"

namespace {

using namespace earshot;

ocean::GeoPosition position_of(const double* degrees) {
  return {.latitude_deg = degrees[0], .longitude_deg = degrees[1]};
}

}  // namespace

extern "C" {

void earshot_to_plane(const double* origin_deg, const double* position_deg, double* north_east_m) {
  const NorthEast plane = ocean::LocalGrid{position_of(origin_deg)}.to_plane(position_of(position_deg));
  north_east_m[0] = plane.north.value;
  north_east_m[1] = plane.east.value;
}

void earshot_to_geographic(const double* origin_deg, const double* north_east_m, double* position_deg) {
  const ocean::GeoPosition position =
      ocean::LocalGrid{position_of(origin_deg)}.to_geographic({.north = Meters{north_east_m[0]}, .east = Meters{north_east_m[1]}});
  position_deg[0] = position.latitude_deg;
  position_deg[1] = position.longitude_deg;
}

void earshot_geodesic(const double* from_deg, const double* to_deg, double* range_m, double* azimuth_rad) {
  const ocean::RangeAndAzimuth result = ocean::geodesic_between(position_of(from_deg), position_of(to_deg));
  *range_m = result.range.value;
  *azimuth_rad = result.azimuth.value;
}

void earshot_radial(const double* from_deg, double azimuth_rad, const double* range_m, std::size_t count,
                    double* latitudes_and_longitudes_deg) {
  for (const ocean::GeoPosition& p : ocean::geodesic_radial(position_of(from_deg), Radians{azimuth_rad}, {range_m, count})) {
    *latitudes_and_longitudes_deg++ = p.latitude_deg;
    *latitudes_and_longitudes_deg++ = p.longitude_deg;
  }
}

}  // extern "C"
