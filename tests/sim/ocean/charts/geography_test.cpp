#include "sim/ocean/charts/geography.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace earshot::ocean {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(Geodesic, MatchesTheLengthOfAQuarterMeridian) {
  // WGS 84's quarter meridian is 10 001 965.729 m (NIMA TR8350.2 by its axes; printed to 1 mm).
  const RangeAndAzimuth r = geodesic_between({.latitude_deg = 0.0, .longitude_deg = 20.0}, {.latitude_deg = 90.0, .longitude_deg = 20.0});
  EXPECT_NEAR(r.range.value, 10'001'965.729, 0.001);
  EXPECT_NEAR(r.azimuth.value, 0.0, 1e-12);
}

TEST(Geodesic, MatchesGeosciencesAustraliasWorkedExample) {
  // Flinders Peak to Buninyong (ICSM, Geocentric Datum of Australia technical manual, Vincenty's formulae, GRS 80): 54 972.271 m at 306 deg
  // 52 min 05.37 s. GRS 80 and WGS 84 differ by 0.1 mm in the minor axis.
  const GeoPosition flinders_peak{.latitude_deg = -(37.0 + 57.0 / 60 + 3.72030 / 3600),
                                  .longitude_deg = 144.0 + 25.0 / 60 + 29.52440 / 3600};
  const GeoPosition buninyong{.latitude_deg = -(37.0 + 39.0 / 60 + 10.15610 / 3600), .longitude_deg = 143.0 + 55.0 / 60 + 35.38390 / 3600};
  const RangeAndAzimuth r = geodesic_between(flinders_peak, buninyong);
  EXPECT_NEAR(r.range.value, 54'972.271, 0.001);
  const double azimuth_deg = std::fmod(r.azimuth.value / kDegree + 360.0, 360.0);
  EXPECT_NEAR(azimuth_deg, 306.0 + 52.0 / 60 + 5.37 / 3600, 0.005 / 3600);  // printed to 0.01 s

  const std::vector<double> range_m = {r.range.value};
  const std::vector<GeoPosition> there = geodesic_radial(flinders_peak, r.azimuth, range_m);
  EXPECT_NEAR(there[0].latitude_deg, buninyong.latitude_deg, 1e-9);  // 0.1 mm
  EXPECT_NEAR(there[0].longitude_deg, buninyong.longitude_deg, 1e-9);
}

TEST(LocalGrid, KeepsTrueRangeAndBearingFromItsOrigin) {
  const LocalGrid grid{.origin = {.latitude_deg = -37.9, .longitude_deg = 179.9}};
  const NorthEast plane{.north = Meters{-30'000.0}, .east = Meters{40'000.0}};  // 50 km, across the date line
  const GeoPosition there = grid.to_geographic(plane);
  EXPECT_LT(there.longitude_deg, 0.0);
  const RangeAndAzimuth r = geodesic_between(grid.origin, there);
  EXPECT_NEAR(r.range.value, 50'000.0, 1e-6);
  EXPECT_NEAR(r.azimuth.value, std::atan2(40.0, -30.0), 1e-9);
  const NorthEast back = grid.to_plane(there);
  EXPECT_NEAR(back.north.value, plane.north.value, 1e-6);
  EXPECT_NEAR(back.east.value, plane.east.value, 1e-6);
}

TEST(LocalGrid, StretchesLengthsElsewhereByNoMoreThanItSays) {
  const LocalGrid grid{.origin = {.latitude_deg = 60.0, .longitude_deg = 5.0}};
  const NorthEast a{.north = Meters{100'000.0}, .east = Meters{0.0}};
  const NorthEast b{.north = Meters{100'000.0}, .east = Meters{1000.0}};  // across the radial, 100 km off
  const double true_length = geodesic_between(grid.to_geographic(a), grid.to_geographic(b)).range.value;
  EXPECT_NEAR(1000.0 / true_length - 1.0, std::pow(100.0 / 6371.0, 2) / 6.0, 1e-6);  // the sphere stands in for the ellipsoid
}

TEST(LocalGrid, StandsOnThePoleToo) {
  const LocalGrid grid{.origin = {.latitude_deg = 90.0, .longitude_deg = 0.0}};
  // A degree of the meridian at the pole is 111 693.98 m (111132.95 - 559.85 cos 2 lat + 1.175 cos 4 lat).
  const GeoPosition ahead = grid.to_geographic({.north = Meters{11'169.398}, .east = Meters{0.0}});
  EXPECT_NEAR(ahead.latitude_deg, 89.9, 1e-7);              // 1 cm, as the degree's length is printed
  EXPECT_NEAR(std::abs(ahead.longitude_deg), 180.0, 1e-9);  // who comes by the meridian of Greenwich goes on along the other
  const GeoPosition right = grid.to_geographic({.north = Meters{0.0}, .east = Meters{11'169.398}});
  EXPECT_NEAR(right.latitude_deg, 89.9, 1e-7);
  EXPECT_NEAR(right.longitude_deg, 90.0, 1e-9);
  const NorthEast back = grid.to_plane(right);
  EXPECT_NEAR(back.north.value, 0.0, 1e-6);
  EXPECT_NEAR(back.east.value, 11'169.398, 1e-6);
}

TEST(Geodesic, GoesStraightOnOverThePole) {
  const std::vector<double> range_m = {5'584.699, 5'584.699 + 11'169.398};  // 0.05 degrees to the pole and 0.1 beyond
  const std::vector<GeoPosition> there = geodesic_radial({.latitude_deg = 89.95, .longitude_deg = 30.0}, Radians{0.0}, range_m);
  EXPECT_NEAR(there[0].latitude_deg, 90.0, 1e-7);
  EXPECT_NEAR(there[1].latitude_deg, 89.9, 1e-7);
  EXPECT_NEAR(there[1].longitude_deg, -150.0, 1e-9);
}

}  // namespace
}  // namespace earshot::ocean
