#include "sim/ocean/charts/geography.hpp"

#include <GeographicLib/AzimuthalEquidistant.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <numbers>

namespace earshot::ocean {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

NorthEast LocalGrid::to_plane(GeoPosition position) const {
  NorthEast plane;
  GeographicLib::AzimuthalEquidistant().Forward(origin.latitude_deg, origin.longitude_deg, position.latitude_deg, position.longitude_deg,
                                                plane.east.value, plane.north.value);
  return plane;
}

GeoPosition LocalGrid::to_geographic(NorthEast position) const {
  GeoPosition geographic;
  GeographicLib::AzimuthalEquidistant().Reverse(origin.latitude_deg, origin.longitude_deg, position.east.value, position.north.value,
                                                geographic.latitude_deg, geographic.longitude_deg);
  return geographic;
}

RangeAndAzimuth geodesic_between(GeoPosition from, GeoPosition to) {
  RangeAndAzimuth result;
  double azimuth_there_deg = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(from.latitude_deg, from.longitude_deg, to.latitude_deg, to.longitude_deg, result.range.value,
                                           result.azimuth.value, azimuth_there_deg);
  result.azimuth = result.azimuth * kDegree;
  return result;
}

std::vector<GeoPosition> geodesic_radial(GeoPosition from, Radians azimuth, std::span<const double> range_m) {
  const GeographicLib::GeodesicLine line(GeographicLib::Geodesic::WGS84(), from.latitude_deg, from.longitude_deg, azimuth.value / kDegree);
  std::vector<GeoPosition> positions(range_m.size());
  for (std::size_t i = 0; i < range_m.size(); ++i) {
    line.Position(range_m[i], positions[i].latitude_deg, positions[i].longitude_deg);
  }
  return positions;
}

}  // namespace earshot::ocean
