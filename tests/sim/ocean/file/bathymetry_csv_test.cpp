#include "sim/ocean/file/bathymetry_csv.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/sim/ocean/charts/chart_files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::ocean {
namespace {

using tests::complaint_of;

constexpr GeoPosition kCentre{.latitude_deg = 42.0, .longitude_deg = -8.0};

void expect_mentions(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
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
  support::TemporaryFolder folder_;
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
