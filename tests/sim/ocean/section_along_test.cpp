#include "sim/ocean/section_along.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "sim/ocean/charts/charts.hpp"
#include "tests/sim/ocean/charts/chart_files.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::ocean {
namespace {

using tests::axis;
using tests::complaint_of;

SedimentLayer mud(double thickness_m, double sound_speed_mps) {
  return {.thickness = Meters{thickness_m}, .sound_speed = MetersPerSecond{sound_speed_mps}};
}

TabulatedProfile isovelocity(double sound_speed_mps) {
  return {.depth_m = {0.0}, .sound_speed_mps = {sound_speed_mps}};
}

Environment flat_sea() {
  return {.name = "flat",
          .water = isovelocity(1500.0),
          .seabed = {.depth = Meters{200.0}, .layers = {mud(0.0, 1700.0)}},
          .source = {},
          .noise_level = {}};
}

TEST(SectionAlong, KeepsWhatBeginsBeyondRangeZeroConstantUpToThere) {
  Environment sea = flat_sea();
  sea.water_stations = {{.range = Meters{1000.0}, .profile = isovelocity(1500.0)},
                        {.range = Meters{3000.0}, .profile = isovelocity(1520.0)}};
  sea.sea_floor_stations = {{.range = Meters{2000.0}, .depth = Meters{200.0}}, {.range = Meters{4000.0}, .depth = Meters{100.0}}};
  sea.sediment_stations = {{.range = Meters{500.0}, .layers = {mud(0.0, 1600.0)}}, {.range = Meters{5000.0}, .layers = {mud(0.0, 1700.0)}}};
  sea.absorption_db_per_km = 0.25;
  const Section section = section_along(sea, {}, Radians{}, Meters{6000.0});
  EXPECT_EQ(section.water.front().range, Meters{0.0});
  EXPECT_EQ(section.sea_floor.front().range, Meters{0.0});
  EXPECT_EQ(section.sediment.front().range, Meters{0.0});
  EXPECT_EQ(sound_speed(section, Meters{500.0}, Meters{20.0}), MetersPerSecond{1500.0});
  EXPECT_EQ(sound_speed(section, Meters{2000.0}, Meters{20.0}), MetersPerSecond{1510.0});
  EXPECT_EQ(sea_floor_depth(section, Meters{1000.0}), Meters{200.0});
  EXPECT_EQ(sea_floor_depth(section, Meters{3000.0}), Meters{150.0});
  EXPECT_EQ(sediment_at(section, Meters{4999.0}).layers.front().sound_speed, MetersPerSecond{1600.0});
  EXPECT_EQ(section.absorption_db_per_km, 0.25);
}

TEST(SectionAlong, IsTheSameEverywhereInAnOceanThatDoesNotChange) {
  const Section section = section_along(flat_sea(), {}, Radians{1.0}, Meters{50'000.0});
  EXPECT_EQ(section.water.size() + section.sea_floor.size() + section.sediment.size(), 3U);
  EXPECT_EQ(sea_floor_depth(section, Meters{30'000.0}), Meters{200.0});
  EXPECT_FALSE(section.shore.has_value());
}

TEST(SectionAlong, EndsWhereAGivenSeaFloorReachesTheSurface) {
  Environment wedge = flat_sea();
  wedge.sea_floor_stations = {{.range = Meters{0.0}, .depth = Meters{200.0}}, {.range = Meters{4000.0}, .depth = Meters{0.0}}};
  const Section section = section_along(wedge, {}, Radians{}, Meters{5000.0});
  EXPECT_EQ(section.shore, Meters{4000.0});
  EXPECT_EQ(sea_floor_depth(section, Meters{1000.0}), Meters{150.0});
}

/// The sea about 45 degN 7 degW, half-degree nodes, its depth a plane in latitude and longitude.
Environment charted_sea(double depth_m, double per_degree_north_m, double per_degree_east_m) {
  Environment sea = flat_sea();
  auto charts = std::make_shared<Charts>();
  charts->grid.origin = {.latitude_deg = 45.0, .longitude_deg = -7.0};
  Bathymetry chart{.file = "chart.nc",
                   .axes = {.centre_longitude_deg = -7.0, .latitude_deg = axis(43.0, 0.5, 9), .longitude_deg = axis(-9.0, 0.5, 9)},
                   .elevation_m = {}};
  for (const double lat : chart.axes.latitude_deg) {
    for (const double lon : chart.axes.longitude_deg) {
      chart.elevation_m.push_back(-(depth_m + per_degree_north_m * (lat - 45.0) + per_degree_east_m * (lon + 7.0)));
    }
  }
  charts->bathymetry = std::move(chart);
  sea.charts = charts;
  return sea;
}

TEST(SectionAlong, FollowsTheChartNorthwards) {
  const Section section = section_along(charted_sea(1000.0, 1000.0, 0.0), {}, Radians{0.0}, Meters{50'000.0});
  // A degree of the meridian is 111.1362 km at 45.22 degN (111132.95 - 559.85 cos 2 lat + 1.175 cos 4 lat), so 50 km are 0.44990 degrees.
  EXPECT_NEAR(sea_floor_depth(section, Meters{50'000.0}).value, 1449.90, 0.01);
  EXPECT_NEAR(sea_floor_depth(section, Meters{25'000.0}).value, 1224.95, 0.01);
}

TEST(SectionAlong, FollowsTheChartOverThePole) {
  const support::TemporaryFolder folder;
  // 1000 m on the pole, 10 m more for each hundredth of a degree from it, on half degrees of latitude as far as the pole.
  tests::GebcoFile{axis(85.0, 0.5, 11), axis(-179.5, 1.0, 360), [](double lat, double) { return -(1000.0 + 1000.0 * (90.0 - lat)); }}.write(
      folder / "arctic.nc");
  Environment sea = flat_sea();
  auto charts = std::make_shared<Charts>();
  charts->grid.origin = {.latitude_deg = 89.95, .longitude_deg = -30.0};
  charts->bathymetry = read_gebco(folder / "arctic.nc", charts->grid.origin, Meters{25'000.0});
  sea.charts = charts;
  for (const double bearing : {0.0, 0.05, -0.05}) {
    const Section section = section_along(sea, {}, Radians{bearing}, Meters{20'000.0});
    // Here the earth is flat to a metre, a degree 111 694 m: the pole is 5584.7 m ahead, and the cosine rule gives the way from it.
    const double from_pole_m = std::sqrt(5584.7 * 5584.7 + 2e4 * 2e4 - 2.0 * 5584.7 * 2e4 * std::cos(bearing));
    EXPECT_NEAR(sea_floor_depth(section, Meters{20'000.0}).value, 1000.0 + 1000.0 * from_pole_m / 111'694.0, 0.02) << bearing;
  }
}

TEST(SectionAlong, EndsInThePlaneWhereItsBearingPoints) {
  const Environment sea = charted_sea(3000.0, 300.0, 1000.0);
  const NorthEast from{.north = Meters{20'000.0}, .east = Meters{-30'000.0}};
  const double bearing = 2.2;
  const Meters range{60'000.0};
  const Section section = section_along(sea, from, Radians{bearing}, range);
  const NorthEast end = from + range * UnitNorthEast{.north = std::cos(bearing), .east = std::sin(bearing)};
  const GeoPosition there = sea.charts->grid.to_geographic(end);
  // The plane stretches lengths by up to 2e-5 here: 1.2 m of 60 km, over a slope of 1 in 75.
  EXPECT_NEAR(sea_floor_depth(section, range).value, 3000.0 + 300.0 * (there.latitude_deg - 45.0) + 1000.0 * (there.longitude_deg + 7.0),
              0.02);
}

TEST(SectionAlong, EndsOnTheShore) {
  const Section section = section_along(charted_sea(1000.0, -2000.0, 0.0), {}, Radians{0.0}, Meters{100'000.0});
  ASSERT_TRUE(section.shore.has_value());
  // The sea floor comes up at 45.5 degN; half a degree of meridian at 45.25 degN is 55.5683 km.
  EXPECT_NEAR(section.shore->value, 55'568.3, 1.0);
  EXPECT_EQ(section.sea_floor.back().depth, Meters{0.0});
  EXPECT_EQ(section.sea_floor.back().range, *section.shore);
}

TEST(SectionAlong, RefusesToBeginOnLandOrToLeaveTheChart) {
  const std::string land = complaint_of([] { (void)section_along(charted_sea(-25.0, 0.0, 0.0), {}, Radians{}, Meters{1000.0}); });
  EXPECT_TRUE(support::has_line(land, {"chart.nc", "45", "-7", "25 m", "above", "surface"})) << land;
  const std::string outside = complaint_of([] { (void)section_along(charted_sea(1000.0, 0.0, 0.0), {}, Radians{}, Meters{300'000.0}); });
  EXPECT_NE(outside.find("chart.nc: no elevation at latitude 47"), std::string::npos) << outside;
}

/// 25 degC on 45 degN, a degree more for each tenth of a degree north, 35 psu; measured at two depths.
Environment measured_sea(double sea_floor_m, double data_end_m) {
  Environment sea = flat_sea();
  sea.seabed.depth = Meters{sea_floor_m};
  auto charts = std::make_shared<Charts>();
  charts->grid.origin = {.latitude_deg = 45.0, .longitude_deg = -7.0};
  charts->formula = SoundSpeedFormula::kMackenzie;
  Climatology water;
  water.file = "woa.nc";
  water.axes.centre_longitude_deg = -7.0;
  water.axes.latitude_deg = axis(44.0, 0.5, 5);
  water.axes.longitude_deg = axis(-8.0, 0.5, 5);
  water.depth_m = {0.0, data_end_m};
  water.salinity_psu.assign(50, 35.0);
  for (int level = 0; level < 2; ++level) {
    for (const double lat : water.axes.latitude_deg) water.temperature_c.insert(water.temperature_c.end(), 5, 25.0 + 10.0 * (lat - 45.0));
  }
  charts->climatology = std::move(water);
  sea.charts = charts;
  return sea;
}

TEST(SectionAlong, ChangesItsWaterWithTheClimatology) {
  const Section section = section_along(measured_sea(200.0, 1000.0), {}, Radians{0.0}, Meters{55'568.3});  // to 45.5 degN
  EXPECT_NEAR(sound_speed(section, Meters{0.0}, Meters{1000.0}).value, 1550.744, 0.001);                   // Mackenzie's check value
  // Surface, 30 degC, 35 psu: 1448.96 + 137.73 - 47.736 + 6.4098 by hand.
  EXPECT_NEAR(sound_speed(section, Meters{55'568.3}, Meters{0.0}).value, 1545.364, 0.001);
  EXPECT_FALSE(section.unmeasured.has_value());
}

TEST(SectionAlong, KnowsWhatOfItsWaterWasNotMeasured) {
  const Section section = section_along(measured_sea(3000.0, 1500.0), {}, Radians{0.0}, Meters{50'000.0});
  ASSERT_TRUE(section.unmeasured.has_value());
  EXPECT_EQ(section.unmeasured->data_end, Meters{1500.0});
  EXPECT_EQ(section.unmeasured->sea_floor, Meters{3000.0});
  EXPECT_TRUE(support::tells(to_string(*section.unmeasured), {"woa.nc", "1500 m", "3000 m"}));
  EXPECT_FALSE(section_along(measured_sea(1600.0, 1500.0), {}, Radians{0.0}, Meters{50'000.0}).unmeasured);  // within a level
}

}  // namespace
}  // namespace earshot::ocean
