#include "firmware/wire/n2k/local_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace earshot::n2k {
namespace {

constexpr double kRadiansPerDegree = 3.141592653589793 / 180.0;

LocalPlane plane_about(double latitude_deg, double longitude_deg) {
  return LocalPlane::about({latitude_deg, longitude_deg}).value();
}

/// A geodesic from GeographicLib 2.0 (Python, Geodesic.WGS84.Inverse): its length, and the mean of the azimuths at its ends.
struct Geodesic {
  Geographic from;
  Geographic to;
  double length_m;
  double azimuth_deg;
  double tolerance_m;  ///< what mid-latitude sailing is off by: third order in the distance, growing with tan(latitude)
};

TEST(LocalPlane, AgreesWithGeographicLibsGeodesics) {
  const Geodesic geodesics[] = {
      {{0, 0}, {0.2, 0.1}, 24'758.5672, 26.719283, 0.05},       {{30, -30}, {30.2, -29.8}, 29'379.9473, 41.007511, 0.1},
      {{46, -1.3}, {46.2, -1.1}, 27'080.5945, 34.824396, 0.1},  {{-60, 179.9}, {-59.9, -179.8}, 20'129.5214, 56.394526, 0.2},
      {{46, -1.3}, {46.8, -0.3}, 117'565.6215, 40.853778, 6.0},
  };
  for (const Geodesic& geodesic : geodesics) {
    const Result<NorthEast> position = LocalPlane::about(geodesic.from).value().to_local(geodesic.to);
    ASSERT_TRUE(position.ok());
    const double azimuth = geodesic.azimuth_deg * kRadiansPerDegree;
    EXPECT_NEAR(position.value().north.value, geodesic.length_m * std::cos(azimuth), geodesic.tolerance_m) << geodesic.from.latitude_deg;
    EXPECT_NEAR(position.value().east.value, geodesic.length_m * std::sin(azimuth), geodesic.tolerance_m) << geodesic.from.latitude_deg;
  }
}

TEST(LocalPlane, ComesBackToTheSamePlaceWithinAMicrometre) {
  for (const double latitude : {-75.0, -30.0, 0.0, 46.0, 80.0}) {
    const LocalPlane plane = plane_about(latitude, 20.0);
    for (const double north : {-30'000.0, 0.0, 25'000.0}) {
      for (const double east : {-25'000.0, 1.0, 30'000.0}) {
        const Result<Geographic> place = plane.to_geographic({Meters{north}, Meters{east}});
        ASSERT_TRUE(place.ok());
        const Result<NorthEast> back = plane.to_local(place.value());
        ASSERT_TRUE(back.ok());
        EXPECT_NEAR(back.value().north.value, north, 1e-6);  // degrees in double hold 1e-9 m; the fixed point adds its last digits
        EXPECT_NEAR(back.value().east.value, east, 1e-6);
      }
    }
  }
}

TEST(LocalPlane, CrossesTheDateLine) {
  const Result<NorthEast> position = plane_about(0.0, 179.9).to_local({0.0, -179.9});
  ASSERT_TRUE(position.ok());
  EXPECT_NEAR(position.value().east.value, 0.2 * 111'319.4908, 1e-3);  // a degree of the equator: 2 pi 6378137 m / 360
  EXPECT_NEAR(plane_about(0.0, 179.9).to_geographic(position.value()).value().longitude_deg, -179.9, 1e-9);  // 0.1 mm
  const Result<NorthEast> westward = plane_about(0.0, -179.9).to_local({0.0, 179.9});
  ASSERT_TRUE(westward.ok());
  EXPECT_NEAR(westward.value().east.value, -0.2 * 111'319.4908, 1e-3);
  EXPECT_NEAR(plane_about(0.0, -179.9).to_geographic(westward.value()).value().longitude_deg, 179.9, 1e-9);
}

TEST(LocalPlane, HasItsOriginAnywhereUpTo80DegreesAndTheDateLine) {
  for (const Geographic& origin : {Geographic{80.0, 180.0}, Geographic{-80.0, -180.0}}) {
    const Result<LocalPlane> plane = LocalPlane::about(origin);
    ASSERT_TRUE(plane.ok());
    EXPECT_EQ(plane.value().to_geographic({}).value().latitude_deg, origin.latitude_deg);
    EXPECT_EQ(plane.value().to_geographic({}).value().longitude_deg, origin.longitude_deg);
  }
  for (const Geographic& place : {Geographic{80.1, 0}, Geographic{-80.1, 0}, Geographic{0, 180.1}, Geographic{0, -180.1}})
    EXPECT_EQ(LocalPlane::about(place).status(), Status::kOutOfRange);
}

TEST(LocalPlane, ReachesTwoDegreesEveryWay) {
  const LocalPlane plane = plane_about(46.0, -1.5);
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(plane.to_local({46.0 + 2.0 * sign, -1.5}).ok());
    EXPECT_EQ(plane.to_local({46.0 + 2.01 * sign, -1.5}).status(), Status::kOutOfRange);
    EXPECT_TRUE(plane.to_local({46.0, -1.5 + 2.0 * sign}).ok());
    EXPECT_EQ(plane.to_local({46.0, -1.5 + 2.01 * sign}).status(), Status::kOutOfRange);
    // A degree of latitude is 111.1 km here, one of longitude 111.3 km * cos 46 = 77.5 km.
    EXPECT_TRUE(plane.to_geographic({Meters{222e3 * sign}, Meters{}}).ok());
    EXPECT_EQ(plane.to_geographic({Meters{223e3 * sign}, Meters{}}).status(), Status::kOutOfRange);
    EXPECT_TRUE(plane.to_geographic({Meters{}, Meters{154e3 * sign}}).ok());
    EXPECT_EQ(plane.to_geographic({Meters{}, Meters{157e3 * sign}}).status(), Status::kOutOfRange);
  }
}

TEST(LocalPlane, RefusesPlacesThatAreNotNearOrNotNumbers) {
  const LocalPlane plane = plane_about(46.0, -1.3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(plane.to_local({48.1, -1.3}).status(), Status::kOutOfRange);
  EXPECT_EQ(plane.to_local({46.0, 1.0}).status(), Status::kOutOfRange);
  EXPECT_EQ(plane.to_local({nan, -1.3}).status(), Status::kOutOfRange);
  EXPECT_EQ(plane.to_geographic({Meters{1e6}, Meters{0}}).status(), Status::kOutOfRange);
  EXPECT_EQ(plane.to_geographic({Meters{0}, Meters{nan}}).status(), Status::kOutOfRange);
  EXPECT_EQ(LocalPlane::about({81.0, 0.0}).status(), Status::kOutOfRange);
  EXPECT_EQ(LocalPlane::about({0.0, 180.1}).status(), Status::kOutOfRange);
}

}  // namespace
}  // namespace earshot::n2k
