#include "sim/ocean/bathymetry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "tests/sim/netcdf/temporary_folder.hpp"
#include "tests/sim/ocean/chart_files.hpp"

namespace earshot::ocean {
namespace {

using tests::axis;
using tests::complaint_of;
using tests::GebcoFile;

constexpr GeoPosition kCentre{.latitude_deg = 42.0, .longitude_deg = -8.0};

void expect_mentions(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

GebcoFile slope() {
  return {axis(40, 0.5, 9), axis(-10, 0.5, 9), [](double lat, double lon) { return -1000.0 * (lat - 40.0) - 100.0 * (lon + 10.0) - 10.0; }};
}

TEST(Bathymetry, IsBilinearBetweenItsNodes) {
  const tests::TemporaryFolder folder;
  slope().write(folder / "g.nc");
  const Bathymetry chart = read_gebco(folder / "g.nc", kCentre, Meters{50'000.0});
  // A plane in latitude and longitude is what bilinear interpolation leaves alone: 1000 x 1.75 + 100 x 2.125 + 10.
  EXPECT_NEAR(sea_floor_depth(chart, {.latitude_deg = 41.75, .longitude_deg = -7.875}).value, 1972.5, 1e-9);
}

TEST(Bathymetry, SaysWhereItHasNoValue) {
  const tests::TemporaryFolder folder;
  slope().write(folder / "g.nc");
  const Bathymetry chart = read_gebco(folder / "g.nc", kCentre, Meters{10'000.0});
  expect_mentions(complaint_of([&] { (void)sea_floor_depth(chart, {.latitude_deg = 40.1, .longitude_deg = -8.0}); }),
                  "g.nc: no elevation at latitude 40.1, longitude -8 (outside the file or the reach_km that was read)");
}

TEST(Bathymetry, RefusesAnotherLayoutOrUnit) {
  const tests::TemporaryFolder folder;
  const auto complaint = [&](const GebcoFile& layout) {
    layout.write(folder / "g.nc");
    return complaint_of([&] { (void)read_gebco(folder / "g.nc", kCentre, Meters{1000.0}); });
  };
  GebcoFile layout = slope();
  layout.variable = "z";
  expect_mentions(complaint(layout), "g.nc: elevation: no such variable");
  layout = slope();
  layout.units = "feet";
  expect_mentions(complaint(layout), "g.nc: elevation: units must be m, are feet");
  layout = slope();
  layout.transposed = true;
  expect_mentions(complaint(layout), "g.nc: elevation: must have the dimensions (lat, lon)");
}

TEST(Bathymetry, RefusesAFillValueThatTheFileDoesNotDeclare) {
  const tests::TemporaryFolder folder;
  GebcoFile layout = slope();
  layout.elevation_m = [](double lat, double lon) { return lat == 42.0 && lon == -8.0 ? -32767.0 : -100.0; };
  layout.write(folder / "g.nc");
  expect_mentions(complaint_of([&] { (void)read_gebco(folder / "g.nc", kCentre, Meters{1000.0}); }),
                  "g.nc: elevation: holds -32767 at latitude 42, longitude -8, must be from -12000 to 10000 m");
}

TEST(Bathymetry, RefusesATruncatedFile) {
  const tests::TemporaryFolder folder;
  slope().write(folder / "g.nc");
  std::filesystem::resize_file(folder / "g.nc", std::filesystem::file_size(folder / "g.nc") - 100);
  expect_mentions(complaint_of([&] { (void)read_gebco(folder / "g.nc", kCentre, Meters{1000.0}); }), "g.nc: not a whole NetCDF file");
}

class BathymetryCsv : public testing::Test {
 protected:
  std::string grid_complaint(const std::string& lines) {
    std::ofstream(folder_ / "b.csv") << "latitude_deg,longitude_deg,elevation_m\n" << lines;
    return complaint_of([&] { (void)read_bathymetry_csv(folder_ / "b.csv", kCentre); });
  }
  std::string section_complaint(const std::string& lines) {
    std::ofstream(folder_ / "s.csv") << "range_m,depth_m\n" << lines;
    return complaint_of([&] { (void)read_section_csv(folder_ / "s.csv"); });
  }
  tests::TemporaryFolder folder_;
};

TEST_F(BathymetryCsv, IsReadInAnyOrderOfLinesAndEitherSenseOfLongitude) {
  ASSERT_EQ(grid_complaint("42,353,-200\n42,351,-100\n43,353,-400\n43,351,-300\n"), "no error");
  const Bathymetry chart = read_bathymetry_csv(folder_ / "b.csv", kCentre);
  EXPECT_NEAR(sea_floor_depth(chart, {.latitude_deg = 42.5, .longitude_deg = -8.5}).value, 225.0, 1e-9);  // (1.5 / 2 west) 200, 25 east
}

TEST_F(BathymetryCsv, NamesTheGapTheDoubleAndTheImpossible) {
  expect_mentions(grid_complaint("42,-9,-100\n42,-7,-200\n43,-9,-300\n"), "gap in the grid: no line for latitude 43, longitude -7");
  expect_mentions(grid_complaint("42,-9,-100\n42,-7,-200\n43,-9,-300\n43,-9,-300\n"),
                  "b.csv:5: longitude_deg = -9: this position was there before");
  expect_mentions(grid_complaint("42,-9,-13000\n"),
                  "b.csv:2: elevation_m = -13000: must be a finite number of at least -12000 and at most 10000");
  expect_mentions(grid_complaint("42,-9,-100\n"), "must be a grid of at least 2 latitudes and 2 longitudes");
}

TEST_F(BathymetryCsv, SectionEndsOnTheShoreButDoesNotRiseAboveTheSurface) {
  EXPECT_EQ(section_complaint("0,200\n4000,0\n"), "no error");
  expect_mentions(section_complaint("0,200\n4000,-10\n"),
                  "s.csv:3: depth_m = -10: must be a finite number of at least 0 and at most 12000");
  expect_mentions(section_complaint("0,200\n2000,0\n4000,100\n"), "s.csv:3: depth_m = 0: must be above 0 everywhere but in the last");
  expect_mentions(section_complaint("0,200\n2000,150\n2000,100\n"), "s.csv:4: range_m = 2000: must be more than in the line before");
}

}  // namespace
}  // namespace earshot::ocean
