#pragma once

#include <span>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"

namespace earshot::ocean {

/// A position on the WGS 84 ellipsoid.
struct GeoPosition {
  double latitude_deg = 0.0;   ///< -90 to 90, north positive
  double longitude_deg = 0.0;  ///< -180 to 180, east positive
};

/// The local north-east plane about a geographic origin: azimuthal equidistant projection.
///
/// Range and bearing from the origin are true (chosen before a tangent plane for this: no height enters, and the search's distances are
/// sound's distances); elsewhere lengths across are too long by (d / 6371 km)^2 / 6, 0.004 % at 100 km.
/// Oracle: LocalGrid.KeepsTrueRangeAndBearingFromItsOrigin
struct LocalGrid {
  GeoPosition origin;

  [[nodiscard]] NorthEast to_plane(GeoPosition position) const;
  [[nodiscard]] GeoPosition to_geographic(NorthEast position) const;
};

struct RangeAndAzimuth {
  Meters range;
  Radians azimuth;  ///< at the first position, clockwise from true north
};

/// The geodesic from one position to another.
/// Oracle: Geodesic.MatchesTheLengthOfAQuarterMeridian
[[nodiscard]] RangeAndAzimuth geodesic_between(GeoPosition from, GeoPosition to);

/// Positions on the geodesic that leaves `from` at `azimuth`, at each of `range_m`.
[[nodiscard]] std::vector<GeoPosition> geodesic_radial(GeoPosition from, Radians azimuth, std::span<const double> range_m);

}  // namespace earshot::ocean
