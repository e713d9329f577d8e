#include "sim/ocean/charts/bathymetry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "tests/sim/ocean/charts/chart_files.hpp"
#include "tests/support/temporary_folder.hpp"

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
  const support::TemporaryFolder folder;
  slope().write(folder / "g.nc");
  const Bathymetry chart = read_gebco(folder / "g.nc", kCentre, Meters{50'000.0});
  // A plane in latitude and longitude is what bilinear interpolation leaves alone: 1000 x 1.75 + 100 x 2.125 + 10.
  EXPECT_NEAR(sea_floor_depth(chart, {.latitude_deg = 41.75, .longitude_deg = -7.875}).value, 1972.5, 1e-9);
}

TEST(Bathymetry, SaysWhereItHasNoValue) {
  const support::TemporaryFolder folder;
  slope().write(folder / "g.nc");
  const Bathymetry chart = read_gebco(folder / "g.nc", kCentre, Meters{10'000.0});
  expect_mentions(complaint_of([&] { (void)sea_floor_depth(chart, {.latitude_deg = 40.1, .longitude_deg = -8.0}); }),
                  "g.nc: no elevation at latitude 40.1, longitude -8 (outside the file or the reach_km that was read)");
}

TEST(Bathymetry, RefusesAnotherLayoutOrUnit) {
  const support::TemporaryFolder folder;
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
  const support::TemporaryFolder folder;
  GebcoFile layout = slope();
  layout.elevation_m = [](double lat, double lon) { return lat == 42.0 && lon == -8.0 ? -32768.0 : -100.0; };
  layout.write(folder / "g.nc");
  expect_mentions(complaint_of([&] { (void)read_gebco(folder / "g.nc", kCentre, Meters{1000.0}); }),
                  "g.nc: elevation: holds -32768 at latitude 42, longitude -8, must be from -12000 to 10000 m");
}

TEST(Bathymetry, RefusesAFillValueThatCouldBeADepth) {
  const support::TemporaryFolder folder;
  for (const double fill : {-9999.0, 9999.0, -999.0}) {
    for (const double beside : {-8.0, -7.5}) {  // one node, and two side by side
      GebcoFile layout = slope();
      layout.elevation_m = [=](double lat, double lon) { return lat == 42.0 && lon >= -8.0 && lon <= beside ? fill : -4000.0 - lat; };
      layout.write(folder / "g.nc");
      const std::string said = complaint_of([&] { (void)read_gebco(folder / "g.nc", kCentre, Meters{100'000.0}); });
      std::ostringstream wanted;
      wanted << "g.nc: elevation: holds " << fill << " at latitude 42, longitude -8, which cannot be beside its neighbours";
      expect_mentions(said, wanted.str());
    }
  }
}

TEST(Bathymetry, RefusesASpikeThatNoSlopeLeadsTo) {
  const support::TemporaryFolder folder;
  GebcoFile layout = slope();
  layout.latitude_deg = axis(41.99, 0.004, 6);  // 445 m between nodes
  layout.longitude_deg = axis(-8.01, 0.004, 6);
  double spike_m = -3000.0;  // 1500 m above its neighbours
  layout.elevation_m = [&](double lat, double lon) {
    return std::abs(lat - 41.998) < 0.001 && std::abs(lon + 8.002) < 0.001 ? spike_m : -4500.0;
  };
  layout.write(folder / "g.nc");
  expect_mentions(complaint_of([&] { (void)read_gebco(folder / "g.nc", {.latitude_deg = 42.0, .longitude_deg = -8.0}, Meters{1000.0}); }),
                  "holds -3000 at latitude 41.998, longitude -8.002");
  spike_m = -4000.0;
  layout.write(folder / "g.nc");
  EXPECT_NO_THROW((void)read_gebco(folder / "g.nc", {.latitude_deg = 42.0, .longitude_deg = -8.0}, Meters{1000.0}));
}

TEST(Bathymetry, RefusesAHoleThatSomebodyFilledWithANumberOfHisOwn) {
  const support::TemporaryFolder folder;
  const auto complaint = [&](double step_deg, double fill, double sea_floor) {
    GebcoFile layout = slope();
    layout.latitude_deg = axis(42.0 - 3.0 * step_deg, step_deg, 7);
    layout.longitude_deg = axis(-8.0 - 3.0 * step_deg, step_deg, 7);
    layout.elevation_m = [=](double lat, double lon) {
      return std::abs(lat - 42.0) < 1.5 * step_deg && lon > -8.0 + 0.5 * step_deg && lon < -8.0 + 2.5 * step_deg ? fill
                                                                                                                 : sea_floor - lat - lon;
    };
    layout.write(folder / "g.nc");
    return complaint_of([&] { (void)read_gebco(folder / "g.nc", kCentre, Meters{3.0 * step_deg * 100'000.0}); });
  };
  expect_mentions(complaint(0.004, -8000.0, -2000.0), "g.nc: elevation: holds -8000 at latitude 41.996, longitude -7.996, which cannot be");
  expect_mentions(complaint(0.25, -10'000.0, -2000.0), "g.nc: elevation: holds -10000 at latitude 41.75, longitude -7.75, which cannot be");
  EXPECT_EQ(complaint(0.004, -2700.0, -2000.0), "no error") << "a flat hollow 700 m deeper, 330 m and more between nodes";
  EXPECT_EQ(complaint(0.25, -6000.0, -2000.0), "no error") << "a flat trench, 28 km between nodes";
}

TEST(Bathymetry, ReadsATrenchOf9999MetersAndAnIslandOf999) {
  const support::TemporaryFolder folder;
  GebcoFile layout = slope();
  layout.elevation_m = [](double lat, double lon) { return lat == 42.0 && lon == -8.0 ? -9999.0 : -9950.0; };
  layout.write(folder / "g.nc");
  EXPECT_NO_THROW((void)read_gebco(folder / "g.nc", kCentre, Meters{100'000.0}));
  layout.elevation_m = [](double lat, double lon) { return lat == 42.0 && lon == -8.0 ? 999.0 : 200.0; };
  layout.write(folder / "g.nc");
  EXPECT_NO_THROW((void)read_gebco(folder / "g.nc", kCentre, Meters{100'000.0}));
}

TEST(Bathymetry, RefusesATruncatedFile) {
  const support::TemporaryFolder folder;
  slope().write(folder / "g.nc");
  std::filesystem::resize_file(folder / "g.nc", std::filesystem::file_size(folder / "g.nc") - 100);
  expect_mentions(complaint_of([&] { (void)read_gebco(folder / "g.nc", kCentre, Meters{1000.0}); }), "g.nc: not a whole NetCDF file");
}

}  // namespace
}  // namespace earshot::ocean
