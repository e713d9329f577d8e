#include "sim/ocean/charts/climatology.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/sim/ocean/charts/chart_files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::ocean {
namespace {

using tests::AtlasFile;
using tests::axis;
using tests::complaint_of;

constexpr GeoPosition kCentre{.latitude_deg = 42.25, .longitude_deg = -8.0};
constexpr Meters kReach{100'000.0};

double constant_salinity(double, double, double) {
  return 35.0;
}

/// Temperature rises northwards: 25 degC at 42.25 degN.
AtlasFile warm_sea() {
  return {.depth_m = {0.0, 100.0, 500.0},
          .latitude_deg = axis(40.5, 0.5, 8),
          .longitude_deg = axis(-10.5, 0.5, 10),
          .temperature_c = [](double, double lat, double) { return 25.0 + (lat - 42.25); },
          .salinity_psu = constant_salinity};
}

class ClimatologyFile : public testing::Test {
 protected:
  Climatology read(const AtlasFile& layout) {
    layout.write(folder_ / "woa.nc");
    return read_world_ocean_atlas({.temperature = folder_ / "woa.nc", .salinity = folder_ / "woa.nc"}, kCentre, kReach);
  }
  std::string complaint(const AtlasFile& layout) {
    return complaint_of([&] { (void)read(layout); });
  }
  support::TemporaryFolder folder_;
};

void expect_mentions(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST_F(ClimatologyFile, IsBilinearInTemperatureAndSalinity) {
  for (const bool with_time : {true, false}) {
    AtlasFile layout = warm_sea();
    layout.depth_m = {0.0, 100.0, 1000.0};
    layout.with_time = with_time;
    const TabulatedProfile profile = profile_at(read(layout), kCentre, SoundSpeedFormula::kMackenzie);
    // Mackenzie's check value: 1550.744 m/s at 25 degC, 35 psu, 1000 m. 25 is midway between two nodes' floats, 1e-6 degC off.
    ASSERT_EQ(profile.depth_m[2], 1000.0);
    EXPECT_NEAR(profile.sound_speed_mps[2], 1550.744, 0.001);
  }
}

TEST_F(ClimatologyFile, KeepsTheDeepestWaterBelowTheLastDataAndLetsPressureRaiseTheSoundSpeed) {
  AtlasFile layout = warm_sea();
  layout.temperature_c = [](double z, double, double) { return z <= 500.0 ? 25.0 : AtlasFile::kFill; };
  layout.depth_m = {0.0, 500.0, 800.0};
  const TabulatedProfile profile = profile_at(read(layout), kCentre, SoundSpeedFormula::kMackenzie);
  ASSERT_EQ(profile.depth_m[2], 1000.0);
  EXPECT_NEAR(profile.sound_speed_mps[2], 1550.744, 0.001);
  EXPECT_EQ(profile.depth_m.back(), 12'000.0);
}

TEST_F(ClimatologyFile, LeavesNodesOnLandOutOfTheMean) {
  AtlasFile layout = warm_sea();
  layout.depth_m = {0.0, 1000.0};
  layout.temperature_c = [](double, double, double lon) { return lon < -8.0 ? AtlasFile::kFill : 25.0; };
  const GeoPosition by_the_coast{.latitude_deg = 42.2, .longitude_deg = -8.3};  // between land at -8.5 and water at -8
  const TabulatedProfile profile = profile_at(read(layout), by_the_coast, SoundSpeedFormula::kMackenzie);
  EXPECT_NEAR(profile.sound_speed_mps[1], 1550.744, 0.001);
  expect_mentions(
      complaint_of([&] { (void)profile_at(read(layout), {.latitude_deg = 42.2, .longitude_deg = -8.8}, SoundSpeedFormula::kUnesco); }),
      "woa.nc: no water at latitude 42.2, longitude -8.8");
}

TEST_F(ClimatologyFile, RefusesAGapWithinTheWater) {
  AtlasFile layout = warm_sea();
  layout.temperature_c = [](double z, double lat, double lon) {
    return z == 100.0 && lat == 42.0 && lon == -8.0 ? AtlasFile::kFill : 10.0;
  };
  expect_mentions(complaint(layout), "woa.nc: t_an: gap at latitude 42, longitude -8, depth 100 m");
}

TEST_F(ClimatologyFile, RefusesOtherUnitsDepthsAndValues) {
  AtlasFile layout = warm_sea();
  layout.temperature_units = "kelvin";
  expect_mentions(complaint(layout), "woa.nc: t_an: units must be degrees_celsius, are kelvin");
  layout = warm_sea();
  layout.depth_m = {0.0, 100.0, 50.0};
  expect_mentions(complaint(layout), "woa.nc: depth: must increase throughout");
  layout.depth_m = {10.0, 100.0};
  expect_mentions(complaint(layout), "woa.nc: depth: must begin at 0");
  layout = warm_sea();
  layout.temperature_c = [](double, double, double) { return 288.0; };
  expect_mentions(complaint(layout), "woa.nc: t_an: holds 288 at latitude 41, longitude -9.5, depth 0 m, must be from -3 to 45");
}

TEST_F(ClimatologyFile, RefusesSeveralMonthsRatherThanTakeTheFirst) {
  AtlasFile layout = warm_sea();
  layout.times = 12;
  expect_mentions(complaint(layout), "woa.nc: t_an: has 12 times, must have one");
}

TEST_F(ClimatologyFile, RefusesTemperatureAndSalinityOnDifferentGrids) {
  warm_sea().write(folder_ / "t.nc");
  AtlasFile other = warm_sea();
  other.depth_m = {0.0, 100.0, 600.0};
  other.write(folder_ / "s.nc");
  expect_mentions(
      complaint_of([&] { (void)read_world_ocean_atlas({.temperature = folder_ / "t.nc", .salinity = folder_ / "s.nc"}, kCentre, kReach); }),
      "s.nc: s_an: must have the grid of t_an");
}

TEST_F(ClimatologyFile, RefusesBathymetryInItsPlace) {
  tests::GebcoFile{axis(40, 1, 5), axis(-10, 1, 5), [](double, double) { return -100.0; }}.write(folder_ / "g.nc");
  expect_mentions(
      complaint_of([&] { (void)read_world_ocean_atlas({.temperature = folder_ / "g.nc", .salinity = folder_ / "g.nc"}, kCentre, kReach); }),
      "g.nc: t_an: no such variable");
}

}  // namespace
}  // namespace earshot::ocean
