#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/status.hpp"

namespace earshot::n2k {

/// A place on the WGS-84 ellipsoid, degrees as on the bus.
struct Geographic {
  double latitude_deg = 0.0;   ///< north positive, [-90, 90]
  double longitude_deg = 0.0;  ///< east positive, [-180, 180]
};

/// The mission's north-east plane about a geographic origin.
///
///   north = M(phi_m) (phi - phi_0),   east = N(phi_m) cos(phi_m) (lambda - lambda_0),   phi_m = (phi + phi_0) / 2
///
/// M and N: radii of curvature of the WGS-84 ellipsoid in the meridian and in the prime vertical. Mid-latitude sailing on the ellipsoid.
/// Source: Torge, Geodesy, 3rd ed., Eqs. 4.19 and 4.20 (radii).   Oracle: LocalPlane tests against GeographicLib's geodesics
class LocalPlane {
 public:
  /// The plane about latitude 0, longitude 0.
  LocalPlane() = default;
  /// kOutOfRange unless the latitude is within 80 degrees of the equator and the longitude within [-180, 180].
  [[nodiscard]] static Result<LocalPlane> about(const Geographic& origin);

  /// kOutOfRange unless `place` is finite and within 2 degrees of the origin in latitude and in longitude.
  [[nodiscard]] Result<NorthEast> to_local(const Geographic& place) const;
  /// Inverse of to_local; kOutOfRange where to_local would refuse the result.
  [[nodiscard]] Result<Geographic> to_geographic(const NorthEast& position) const;

 private:
  Geographic origin_;
};

}  // namespace earshot::n2k
