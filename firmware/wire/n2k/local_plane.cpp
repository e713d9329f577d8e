#include "firmware/wire/n2k/local_plane.hpp"

#include "firmware/core/math.hpp"

namespace earshot::n2k {

namespace {

// WGS-84. Source: NGA.STND.0036, Table 3.1 and 3.3.
constexpr double kSemiMajorAxis_m = 6'378'137.0;
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricitySquared = kFlattening * (2.0 - kFlattening);

constexpr double kRadiansPerDegree = 3.141592653589793 / 180.0;
constexpr double kMaxLatitude_deg = 80.0;  ///< of an origin: nearer to a pole the meridians converge too fast for a plane
constexpr double kMaxOffset_deg = 2.0;     ///< from the origin

bool within(double x, double limit) {
  return x >= -limit && x <= limit;
}

/// Metres per degree at a latitude.
struct Scale {
  double north = 0.0;
  double east = 0.0;
};

Scale scale_at(double latitude_deg) {
  const SineCosine phi = sine_cosine(Radians{latitude_deg * kRadiansPerDegree});
  const double w_squared = 1.0 - kEccentricitySquared * phi.sine * phi.sine;
  const double prime_vertical = kSemiMajorAxis_m / sqrt(w_squared);
  const double meridian = prime_vertical * (1.0 - kEccentricitySquared) / w_squared;
  return {meridian * kRadiansPerDegree, prime_vertical * phi.cosine * kRadiansPerDegree};
}

}  // namespace

Result<LocalPlane> LocalPlane::about(const Geographic& origin) {
  if (!within(origin.latitude_deg, kMaxLatitude_deg) || !within(origin.longitude_deg, 180.0)) return Status::kOutOfRange;
  LocalPlane plane;
  plane.origin_ = origin;
  return plane;
}

Result<NorthEast> LocalPlane::to_local(const Geographic& place) const {
  const double d_latitude = place.latitude_deg - origin_.latitude_deg;
  double d_longitude = place.longitude_deg - origin_.longitude_deg;
  if (d_longitude > 180.0) d_longitude -= 360.0;
  if (d_longitude < -180.0) d_longitude += 360.0;
  if (!within(d_latitude, kMaxOffset_deg) || !within(d_longitude, kMaxOffset_deg)) return Status::kOutOfRange;
  const Scale scale = scale_at(origin_.latitude_deg + 0.5 * d_latitude);
  return NorthEast{Meters{scale.north * d_latitude}, Meters{scale.east * d_longitude}};
}

Result<Geographic> LocalPlane::to_geographic(const NorthEast& position) const {
  if (!is_finite(position)) return Status::kOutOfRange;
  // The scale hangs on the mid latitude, that is on the answer: a fixed point that gains at least two digits a turn within two degrees.
  double d_latitude = 0.0;
  for (int turn = 0; turn < 8; ++turn) {
    d_latitude = position.north.value / scale_at(origin_.latitude_deg + 0.5 * d_latitude).north;
    if (!within(d_latitude, kMaxOffset_deg)) return Status::kOutOfRange;
  }
  const double d_longitude = position.east.value / scale_at(origin_.latitude_deg + 0.5 * d_latitude).east;
  if (!within(d_longitude, kMaxOffset_deg)) return Status::kOutOfRange;
  Geographic place{origin_.latitude_deg + d_latitude, origin_.longitude_deg + d_longitude};
  if (place.longitude_deg > 180.0) place.longitude_deg -= 360.0;
  if (place.longitude_deg < -180.0) place.longitude_deg += 360.0;
  return place;
}

}  // namespace earshot::n2k
