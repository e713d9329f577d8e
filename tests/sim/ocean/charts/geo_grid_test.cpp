#include "sim/ocean/charts/geo_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/sim/ocean/charts/chart_files.hpp"
#include "tests/support/temporary_folder.hpp"

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

TEST(GeoWindow, RefusesAPlaceThatTheFileDoesNotCover) {
  const support::TemporaryFolder folder;
  GebcoFile{axis(40, 1, 5), axis(-10, 1, 5), label}.write(folder / "g.nc");
  const netcdf::Reader file(folder / "g.nc");
  EXPECT_NE(complaint_of([&] {
              GeoWindow(file, {.latitude_deg = 50.0, .longitude_deg = -8.0}, Meters{1000.0});
            }).find("g.nc: does not cover latitude 50, longitude -8"),
            std::string::npos);
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
  EXPECT_NE(complaint(layout).find("g.nc: lat: must increase or decrease throughout"), std::string::npos);
  layout.latitude_deg = {40, 41, 42, 91};
  EXPECT_NE(complaint(layout).find("g.nc: lat: holds 91, must lie within 90 degrees of 0"), std::string::npos);
  layout.latitude_deg = {40, 41, std::nan(""), 43};
  EXPECT_NE(complaint(layout).find("g.nc: lat: holds nan"), std::string::npos);
  layout.latitude_deg = {41};
  EXPECT_NE(complaint(layout).find("g.nc: lat: must have at least two values"), std::string::npos);
  layout.latitude_deg = axis(40, 1, 5);
  layout.longitude_deg = {-10, -9, -9.5, -8};
  EXPECT_NE(complaint(layout).find("g.nc: lon: must increase or decrease throughout"), std::string::npos);
  layout.longitude_deg = axis(-10, 1, 5);
  layout.latitude_units = "m";
  EXPECT_NE(complaint(layout).find("g.nc: lat: units must be degrees_north, are m"), std::string::npos);
}

}  // namespace
}  // namespace earshot::ocean
