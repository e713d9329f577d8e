#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::journal {

/// A place on the WGS-84 ellipsoid.
struct MapPlace {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;                                 ///< [-180, 180]
  double depth_m = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not known
  Time time = {};                                             ///< when the vehicle was there, of a place of its track

  [[nodiscard]] bool has_depth() const { return std::isfinite(depth_m); }
};

/// Nothing beyond the plane.
[[nodiscard]] std::optional<MapPlace> place_of(NorthEast place, const n2k::LocalPlane& plane);

/// Degrees with seven decimals, a centimetre of latitude.
[[nodiscard]] std::string degrees_text(double degrees);
/// The place's altitude, which is its depth negative, to the millimetre.
[[nodiscard]] std::string altitude_text(const MapPlace& place);

// What crosses the meridian of 180 degrees is cut there (RFC 7946, 3.1.9): otherwise a map draws it around the whole earth.

/// The line in pieces of two places or more, each on one side. A place where it is cut has the time and the depth between its neighbours'.
[[nodiscard]] std::vector<std::vector<MapPlace>> pieces_of_line(std::span<const MapPlace> line);

/// A ring in pieces of three corners or more, each on one side and counterclockwise (RFC 7946, 3.1.6). The last corner is not the first.
/// Of a ring that is not convex, pieces of one side may be joined by an edge along the meridian.
[[nodiscard]] std::vector<std::vector<MapPlace>> pieces_of_ring(std::span<const MapPlace> corners);

}  // namespace earshot::journal
