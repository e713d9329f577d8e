#include "sim/ocean/charts/geo_grid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/sim/ocean/charts/chart_files.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::ocean {
namespace {

using tests::axis;
using tests::complaint_of;
using tests::GebcoFile;

TEST(GeoGrid, WeighsTheFourNodesAboutAPosition) {
  const GeoAxes axes{.centre_longitude_deg = 10.0, .latitude_deg = {40.0, 41.0, 43.0}, .longitude_deg = {9.0, 10.0, 12.0}};
  const auto cell = cell_at(axes, {.latitude_deg = 41.5, .longitude_deg = 11.0});
  ASSERT_TRUE(cell.has_value());
  EXPECT_EQ(cell->node, (std::array<std::size_t, 4>{4, 5, 7, 8}));
  EXPECT_EQ(cell->weight, (std::array<double, 4>{0.375, 0.375, 0.125, 0.125}));            // a quarter of the way north, halfway east
  EXPECT_TRUE(cell_at(axes, {.latitude_deg = 43.0, .longitude_deg = 372.0}).has_value());  // its very corner, a turn further on
  EXPECT_FALSE(cell_at(axes, {.latitude_deg = 43.01, .longitude_deg = 11.0}).has_value());
  EXPECT_FALSE(cell_at(axes, {.latitude_deg = 41.0, .longitude_deg = 8.9}).has_value());
}

TEST(GeoGrid, CountsThePolesOwnRowAsItsEdge) {
  const GeoAxes arctic{.centre_longitude_deg = 0.0, .latitude_deg = {88.0, 89.0, 90.0}, .longitude_deg = {-180.0, 0.0, 180.0}};
  const auto pole = cell_at(arctic, {.latitude_deg = 90.0, .longitude_deg = -90.0});
  ASSERT_TRUE(pole.has_value());
  EXPECT_EQ(pole->node, (std::array<std::size_t, 4>{3, 4, 6, 7}));
  EXPECT_EQ(pole->weight, (std::array<double, 4>{0.0, 0.0, 0.5, 0.5}));
  const GeoAxes antarctic{.centre_longitude_deg = 0.0, .latitude_deg = {-90.0, -89.0}, .longitude_deg = {-180.0, 0.0, 180.0}};
  const auto south = cell_at(antarctic, {.latitude_deg = -90.0, .longitude_deg = 45.0});
  ASSERT_TRUE(south.has_value());
  EXPECT_EQ(south->node, (std::array<std::size_t, 4>{1, 2, 4, 5}));
  EXPECT_EQ(south->weight, (std::array<double, 4>{0.75, 0.25, 0.0, 0.0}));
}

TEST(GeoGrid, SpacingIsTheShortestSideOfTheMiddleCell) {
  // A degree of the meridian of a sphere of 6371 km is 111.195 km.
  const auto metres = [](std::vector<double> latitude_deg, std::vector<double> longitude_deg) {
    return spacing({.latitude_deg = std::move(latitude_deg), .longitude_deg = std::move(longitude_deg)}).value;
  };
  EXPECT_NEAR(metres({59.0, 60.0, 61.0}, {0.0, 1.0, 2.0}), 0.5 * 111'195.0, 1e-6);                 // cos 60 degrees
  EXPECT_NEAR(metres({-1.0, 0.0, 0.5, 1.0, 2.0}, {10.0, 12.0}), 0.5 * 111'195.0, 1e-6);            // from north to south
  EXPECT_NEAR(metres({-5.0, 0.0, 9.0}, {10.0, 11.0, 11.25, 13.0, 14.0}), 1.75 * 111'195.0, 1e-6);  // east of the middle node
  EXPECT_NEAR(metres({88.0, 90.0, 91.0}, {0.0, 1.0, 2.0}), 0.01 * 111'195.0, 1e-6);  // meridians meet: a hundredth from north to south
}

/// 100 lat + lon in [0, 360): tells every node from every other.
double label(double latitude_deg, double longitude_deg) {
  return 100.0 * latitude_deg + std::fmod(longitude_deg + 360.0, 360.0);
}

void expect_window_shows_labels(const GebcoFile& layout, GeoPosition centre) {
  const support::TemporaryFolder folder;
  layout.write(folder / "g.nc");
  const netcdf::Reader file(folder / "g.nc");
  const GeoWindow window(file, centre, Meters{500'000.0});
  const std::vector<double> values = window.read(file, "elevation", {});
  const GeoAxes& axes = window.axes();
  ASSERT_EQ(values.size(), axes.latitude_deg.size() * axes.longitude_deg.size());
  // 500 km is 4.5 degrees of latitude: 5 nodes to each side and one more or none, by the grid.
  EXPECT_GE(axes.latitude_deg.size(), 10U);
  EXPECT_LE(axes.latitude_deg.size(), 13U);
  for (std::size_t i = 0; i < axes.latitude_deg.size(); ++i) {
    for (std::size_t j = 0; j < axes.longitude_deg.size(); ++j) {
      EXPECT_EQ(values[i * axes.longitude_deg.size() + j], label(axes.latitude_deg[i], axes.longitude_deg[j]));
      if (j > 0) {
        EXPECT_GT(axes.longitude_deg[j], axes.longitude_deg[j - 1]);
      }
    }
    if (i > 0) {
      EXPECT_GT(axes.latitude_deg[i], axes.latitude_deg[i - 1]);
    }
  }
}

TEST(GeoWindow, IsTheSameWhicheverWayTheFileRuns) {
  const GeoPosition centre{.latitude_deg = 45.2, .longitude_deg = -30.3};
  expect_window_shows_labels({axis(0, 1, 90), axis(-179, 1, 360), label}, centre);
  expect_window_shows_labels({axis(89, -1, 90), axis(0, 1, 360), label}, centre);
  expect_window_shows_labels({axis(89, -1, 90), axis(-60, 1, 60), label}, centre);
}

TEST(GeoWindow, CrossesTheDateLineAndGreenwich) {
  for (const double longitude_deg : {179.8, -179.8, 180.0, 0.2, -0.2}) {
    expect_window_shows_labels({axis(0, 1, 90), axis(-180, 1, 361), label}, {.latitude_deg = 30.0, .longitude_deg = longitude_deg});
    expect_window_shows_labels({axis(0, 1, 90), axis(0, 1, 360), label}, {.latitude_deg = 30.0, .longitude_deg = longitude_deg});
  }
}

TEST(GeoWindow, ReadsARegionWhoseLongitudesJumpAtTheDateLine) {
  std::vector<double> longitude_deg = axis(165, 1, 31);  // to 195, which charts of the Pacific write as -165
  for (double& x : longitude_deg) x = x > 180.0 ? x - 360.0 : x;
  for (const double centre_deg : {179.8, -179.8, 180.0})
    expect_window_shows_labels({axis(0, 1, 90), longitude_deg, label}, {.latitude_deg = 30.0, .longitude_deg = centre_deg});
}

/// Degrees of longitude between a place and 20 degrees east, 0 to 180, on whole degrees up to the pole's own row.
GebcoFile polar_tent(std::vector<double> latitude_deg, double first_longitude_deg, int longitudes) {
  return {std::move(latitude_deg), axis(first_longitude_deg, 1, longitudes),
          [](double, double lon) { return std::abs(std::remainder(lon - 20.0, 360.0)); }};
}

TEST(GeoWindow, GoesAllRoundAPoleThatLiesWithinItsReach) {
  const support::TemporaryFolder folder;
  for (const auto& latitude_deg : {axis(80, 1, 11), axis(90, -1, 11), axis(-90, 1, 11), axis(-80, -1, 11)}) {
    const double pole_deg = latitude_deg[5] > 0.0 ? 90.0 : -90.0;
    for (const auto& [first_deg, longitudes] : {std::pair{-180.0, 360}, std::pair{0.0, 360}, std::pair{-180.0, 361}}) {
      polar_tent(latitude_deg, first_deg, longitudes).write(folder / "g.nc");
      const netcdf::Reader file(folder / "g.nc");
      // 6 km from the pole with a reach of 12: what lies behind the pole is on the far side of the meridian at 200.3 degrees.
      const GeoWindow window(file, {.latitude_deg = pole_deg * (89.95 / 90.0), .longitude_deg = 20.3}, Meters{12'000.0});
      const std::vector<double> values = window.read(file, "elevation", {});
      for (double from_20_deg = -179.75; from_20_deg < 180.0; from_20_deg += 0.25) {
        const auto cell = cell_at(window.axes(), {.latitude_deg = pole_deg * (89.97 / 90.0), .longitude_deg = 20.0 + from_20_deg});
        ASSERT_TRUE(cell.has_value()) << from_20_deg;
        double value = 0.0;
        for (std::size_t i = 0; i < 4; ++i) value += cell->weight[i] * values[cell->node[i]];
        ASSERT_NEAR(value, std::abs(from_20_deg), 1e-9);  // linear between whole degrees, rounding
      }
    }
  }
}

TEST(GeoWindow, DoesNotCloseAFileThatLacksADegree) {
  const support::TemporaryFolder folder;
  polar_tent(axis(80, 1, 11), -160.0, 358).write(folder / "g.nc");  // -160 to 197 degrees: 198 and 199 degrees are not in it
  const GeoWindow window(netcdf::Reader(folder / "g.nc"), {.latitude_deg = 89.95, .longitude_deg = 18.5}, Meters{12'000.0});
  EXPECT_TRUE(cell_at(window.axes(), {.latitude_deg = 89.97, .longitude_deg = 196.5}).has_value());
  EXPECT_FALSE(cell_at(window.axes(), {.latitude_deg = 89.97, .longitude_deg = 198.0}).has_value());
  EXPECT_FALSE(cell_at(window.axes(), {.latitude_deg = 89.97, .longitude_deg = 199.0}).has_value());
}

TEST(GeoWindow, RefusesAPlaceThatTheFileDoesNotCover) {
  const support::TemporaryFolder folder;
  GebcoFile{axis(40, 1, 5), axis(-10, 1, 5), label}.write(folder / "g.nc");
  const netcdf::Reader file(folder / "g.nc");
  EXPECT_TRUE(support::has_line(complaint_of([&] { GeoWindow(file, {.latitude_deg = 50.0, .longitude_deg = -8.0}, Meters{1000.0}); }),
                                {"g.nc", "not", "50", "-8"}));
  EXPECT_NE(complaint_of([&] { GeoWindow(file, {.latitude_deg = 42.0, .longitude_deg = 100.0}, Meters{1000.0}); }).find("does not cover"),
            std::string::npos);
}

TEST(GeoWindow, RefusesAxesThatAreNotLatitudeAndLongitude) {
  const support::TemporaryFolder folder;
  const GeoPosition centre{.latitude_deg = 42.0, .longitude_deg = -8.0};
  const auto complaint = [&](const GebcoFile& layout) {
    layout.write(folder / "g.nc");
    return complaint_of([&] { GeoWindow(netcdf::Reader(folder / "g.nc"), centre, Meters{1000.0}); });
  };
  GebcoFile layout{{40, 41, 41, 42}, axis(-10, 1, 5), label};
  EXPECT_TRUE(support::has_line(complaint(layout), {"g.nc", "lat"}));
  layout.latitude_deg = {40, 41, 42, 91};
  EXPECT_TRUE(support::has_line(complaint(layout), {"g.nc", "lat", "91", "within 90 degrees", "0"}));
  layout.latitude_deg = {40, 41, std::nan(""), 43};
  EXPECT_NE(complaint(layout).find("g.nc: lat: holds nan"), std::string::npos);
  layout.latitude_deg = {41};
  EXPECT_TRUE(support::has_line(complaint(layout), {"g.nc", "lat", "at least"}));
  layout.latitude_deg = axis(40, 1, 5);
  layout.longitude_deg = {-10, -9, -9.5, -8};
  EXPECT_TRUE(support::has_line(complaint(layout), {"g.nc", "lon"}));
  layout.longitude_deg = axis(-10, 1, 5);
  layout.latitude_units = "m";
  EXPECT_TRUE(support::has_line(complaint(layout), {"g.nc", "lat", "degrees_north"}));
}

}  // namespace
}  // namespace earshot::ocean
