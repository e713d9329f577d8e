#include "sim/ocean/file/acoustics_toolbox/env_file.hpp"

#include <variant>
#include <vector>

#include "tests/sim/ocean/file/acoustics_toolbox/env_files.hpp"

namespace earshot::ocean::acoustics_toolbox {
namespace {

using tests::kBellhop;
using EnvFile = tests::EnvFiles;

const TabulatedProfile& table_of(const SoundSpeedProfile& profile) {
  return std::get<TabulatedProfile>(profile);
}

TEST_F(EnvFile, GivesOceanSourceAndReceiversOfBellhop) {
  const RadialCase read = load(kBellhop);
  EXPECT_EQ(read.environment.name, "A case");
  EXPECT_EQ(read.environment.source.frequency, Hertz{200.0});
  EXPECT_EQ(read.environment.source.depth, Meters{30.0});
  EXPECT_EQ(table_of(read.environment.water).depth_m, (std::vector<double>{0.0, 40.0, 100.0}));
  EXPECT_EQ(table_of(read.environment.water).sound_speed_mps, (std::vector<double>{1500.0, 1490.0, 1495.0}));
  EXPECT_EQ(read.environment.seabed.depth, Meters{100.0});
  ASSERT_EQ(read.environment.seabed.layers.size(), 1U);
  EXPECT_EQ(read.environment.seabed.layers[0].sound_speed, MetersPerSecond{1650.0});
  EXPECT_EQ(read.environment.seabed.layers[0].density_g_per_cm3, 1.7);
  EXPECT_EQ(read.environment.seabed.layers[0].attenuation_db_per_wavelength, 0.6);
  EXPECT_EQ(read.environment.absorption_db_per_km, 0.0);
  EXPECT_EQ(read.receiver_depth_m, (std::vector<double>{0.0, 20.0, 40.0, 60.0, 80.0}));
  EXPECT_EQ(read.receiver_range_m, (std::vector<double>{500.0, 1000.0, 1500.0}));
  EXPECT_EQ(read.environment.files.size(), 1U);
}

TEST_F(EnvFile, GivesKrakensLayersAndItsMaximumRange) {
  // Two sediment layers, the second with values that its slash leaves as they were on the line before.
  const std::string text =
      "'Layers'\n100\n2\n'CVF'\n0 0 50\n0 1480 0 1.0 0 0\n50 1480 /\n0 0 80\n50 1520 0 1.5 0.2 0\n60 1540 /\n80 1600 0 1.9 /\n"
      "'A' 0\n80 1800 0 2.0 0.1 /\n1400 2000\n12.5\n1\n20 /\n2\n10 40\n";
  const RadialCase read = load(text);
  EXPECT_EQ(read.max_range, Meters{12'500.0});
  EXPECT_TRUE(read.receiver_range_m.empty());
  EXPECT_EQ(read.receiver_depth_m, (std::vector<double>{10.0, 40.0}));
  const auto& layers = read.environment.seabed.layers;
  ASSERT_EQ(layers.size(), 3U);
  EXPECT_EQ(layers[0].thickness, Meters{10.0});
  EXPECT_EQ(layers[0].sound_speed, MetersPerSecond{1520.0});
  EXPECT_EQ(layers[0].sound_speed_at_base, MetersPerSecond{1540.0});
  EXPECT_FALSE(layers[0].density_at_base_g_per_cm3);
  EXPECT_NEAR(layers[0].attenuation_db_per_wavelength, 0.304, 1e-12);  // 0.2 dB/(m kHz) at 1520 m/s
  EXPECT_EQ(layers[1].density_at_base_g_per_cm3, 1.9);
  EXPECT_EQ(layers[2].sound_speed, MetersPerSecond{1800.0});
}

TEST_F(EnvFile, HasItsOwnNameWhereItsTitleIsEmpty) {
  const Environment environment = load(with(kBellhop, "'A case'\n", "\n  \n ''\n")).environment;
  EXPECT_EQ(environment.name, "a");
  EXPECT_EQ(environment.source.frequency, Hertz{200.0});
  EXPECT_EQ(load(with(kBellhop, "'A case'\n", "\n\n A case\n")).environment.name, "A case");
}

TEST_F(EnvFile, ShowsWhatOfItsTitleWouldSteerATerminal) {
  EXPECT_EQ(load(with(kBellhop, "A case", "A\x1b[31mcase")).environment.name, "A\\x1b[31mcase");
}

TEST_F(EnvFile, GivesAllDepthsOfItsSource) {
  const RadialCase read = load(with(kBellhop, "1\n30.0 /", "3\n30.0 40.0 /"));
  EXPECT_EQ(read.source_depth_m, (std::vector<double>{30.0, 35.0, 40.0}));
  EXPECT_EQ(read.environment.source.depth, Meters{30.0});
}

TEST_F(EnvFile, TakesDensitiesRelativeToTheWaters) {
  const std::string salty =
      with(with(with(kBellhop, "0.0 1500.0 /", "0.0 1500.0 0 1.025 /"), "40 1490 0 1 0 /", "40 1490 /"), "1.7 0.6", "2.05 0.6");
  EXPECT_NEAR(load(salty).environment.seabed.layers[0].density_g_per_cm3, 2.0, 1e-15);
  expect_complaint(with(kBellhop, "40 1490 0 1 0 /", "40 1490 0 1.03 /"), "density of the water = 1.03 at 40 m: must be the same");
}

TEST_F(EnvFile, TakesAbsorptionOfTheWaterFromItsPointsOrItsFormula) {
  // 0.001 dB/m at all depths, and Thorp's formula at 200 Hz: 0.0033 + 0.11 0.04/1.04 + 44 0.04/4100.04 + 0.0003 0.04 dB/km.
  const std::string absorbing = with(with(kBellhop, "0.0 1500.0 /", "0.0 1500.0 0 1 0.001 /"), "40 1490 0 1 0 /", "40 1490 /");
  const std::string in_meters = with(with(absorbing, "'CVW'", "'CVM'"), "1.7 0.6", "1.7 0.06");
  EXPECT_NEAR(load(in_meters).environment.absorption_db_per_km, 1.0, 1e-12);
  EXPECT_NEAR(load(with(kBellhop, "'CVW'", "'CVWT'")).environment.absorption_db_per_km, 0.0079720, 1e-7);
  EXPECT_GT(load(with(kBellhop, "'CVW'\n", "'CVWF'\n10 35 8 50\n")).environment.absorption_db_per_km, 0.0);
  expect_complaint(with(kBellhop, "40 1490 0 1 0 /", "40 1490 0 1 0.1 /\n50 1490 0 1 0 /"), "attenuation of the water");
}

TEST_F(EnvFile, TakesTheSeaFloorFromTheFileBesideIt) {
  write("a.bty", "'LS'\n4\n-1 60\n1 80\n2 90\n3 100\n");
  const Environment environment = load(with(kBellhop, "'A' 0.0", "'A~' 0.0")).environment;
  const auto& floor = environment.sea_floor_stations;
  ASSERT_EQ(floor.size(), 4U);
  EXPECT_EQ(floor[0].range, Meters{});
  EXPECT_EQ(floor[0].depth, Meters{70.0});  // half way between -1 and 1 km
  EXPECT_EQ(floor[3].range, Meters{3000.0});
  EXPECT_EQ(environment.seabed.depth, Meters{70.0});
  EXPECT_EQ(environment.files.size(), 2U);
}

TEST_F(EnvFile, TakesTheSedimentOfALongBathymetry) {
  write("a.bty", "'LL'\n2\n0 90 1600 0 1.5 0.5 0\n5 80 1700 0 1.9 0.3 /\n");
  const Environment environment = load(with(kBellhop, "'A' 0.0", "'A*' 0.0")).environment;
  ASSERT_EQ(environment.sediment_stations.size(), 2U);
  EXPECT_EQ(environment.sediment_stations[1].range, Meters{5000.0});
  EXPECT_EQ(environment.sediment_stations[1].layers.at(0).sound_speed, MetersPerSecond{1700.0});
  EXPECT_EQ(environment.seabed.layers.at(0).sound_speed, MetersPerSecond{1600.0});
}

TEST_F(EnvFile, TakesWaterThatChangesWithRangeFromTheFileBesideIt) {
  write("a.ssp", "3\n-2 2 4\n1500 1520 1510\n1490 1492 1494\n1495 1495 1495\n");
  const Environment environment = load(with(kBellhop, "'CVW'", "'QVW'")).environment;
  ASSERT_EQ(environment.water_stations.size(), 3U);
  EXPECT_EQ(environment.water_stations[0].range, Meters{});
  EXPECT_EQ(table_of(environment.water_stations[0].profile).sound_speed_mps, (std::vector<double>{1510.0, 1491.0, 1495.0}));
  EXPECT_EQ(environment.water_stations[2].range, Meters{4000.0});
  EXPECT_EQ(table_of(environment.water_stations[2].profile).depth_m, (std::vector<double>{0.0, 40.0, 100.0}));
  EXPECT_EQ(environment.files.size(), 2U);
}

TEST_F(EnvFile, RefusesWithItsLineWhatItHasNoMeaningFor) {
  const std::string solid = with(kBellhop, "100.0 1650.0 0.0 1.7", "100.0 1650.0 400.0 1.7");
  expect_complaint(solid, "a.env:10: shear speed in m/s = 400: must be 0: only fluid media are computed");
  expect_complaint(with(kBellhop, "'A' 0.0", "'R' 0.0"), "a.env:9: bottom options = R : the first letter must be A, a half-space");
  expect_complaint(with(kBellhop, "'A' 0.0", "'A' 0.5"), "a.env:9: roughness in m = 0.5: must be 0");
  expect_complaint(with(kBellhop, "'CVW'", "'AVW'"), "a.env:4: top options = AVW   : the first letter must be C, N, S or Q");
  expect_complaint(with(kBellhop, "'CVW'", "'CAW'"), "the second letter must be V");
  expect_complaint(with(kBellhop, "'CVW'", "'CVm'"), "the third letter must be N, M, F, W, Q or L");
  expect_complaint(with(kBellhop, "'CVW'", "'CVWB'"), "the fourth letter must be a blank, T or F");
  expect_complaint(with(kBellhop, "'CVW'", "'CVW *'"), "the fifth letter must be a blank, - or _");
  expect_complaint(with(kBellhop, "'CVW'", "'CVW  B'"), "nothing behind the fifth letter");
  expect_complaint(with(kBellhop, "'C'\n", "'I'\n"), "a.env:17: run type = I    : the first letter must be C, R, E, A or a");
  expect_complaint(with(kBellhop, "'C'\n", "501\n"), "a.env:17: run type = 501  : the first letter");  // of a file in three dimensions
  expect_complaint(with(kBellhop, "'C'\n", "'C  X'\n"), "the fourth letter must not be X");
  expect_complaint(with(kBellhop, "30.0 /", "100.0 /"),
                   "a.env:12: source depth in m = 100: must be in the water, above 0 and less than 100");
  expect_complaint(with(kBellhop, "200.0 !", "0.5 !"), "a.env:2: frequency in Hz = 0.5: must be");
  expect_complaint(with(kBellhop, "100.0 1495.0 /", "90.0 1495.0 /"), "a.env:9: profile down to 100 m = A: must be a finite number");
  expect_complaint(with(kBellhop, "100.0 1495.0 /", "110.0 1495.0 /"),
                   "a.env:8: depth in m = 110: a medium must end with a line of its own bottom, 100");
  expect_complaint(with(kBellhop, "0.0 1500.0 /", "5.0 1500.0 /"), "a.env:6: depth in m = 5: a medium must begin where");
  expect_complaint(with(kBellhop, "0.5 1.0 1.5", "0 1e-9 4e-9"),
                   "a.env:16: receiver ranges in km = 4e-09: one at least must be 0.00001 or more");
  expect_complaint(with(kBellhop, "0.5 1.0 1.5", "0.5 1.5 1.0"), "a.env:16: receiver ranges in km = 1: must increase");
  expect_complaint(with(kBellhop, "5\n0 80 /", "5\n0 40 80 /"), "receiver depths in m = 3 numbers: must be 5, or the first and the last");
  expect_complaint("", "a.env:1: title = nothing: the file ends too early");
  expect_complaint(with(kBellhop, "'A' 0.0", "'A~' 0.0"), "a.bty: no such file");
}

TEST_F(EnvFile, RefusesWithItsLineWhatIsWrongInAFileBesideIt) {
  const std::string sloping = with(kBellhop, "'A' 0.0", "'A~' 0.0");
  write("a.bty", "'LS'\n2\n0 90\n5 120\n");
  expect_complaint(sloping, "a.bty:4: depth in m = 120: must not be more than the depth that the profile of the water ends at, 100");
  write("a.bty", "'LS'\n3\n0 90\n5 80\n5 70\n");
  expect_complaint(sloping, "a.bty:5: range in km = 5: must be more than the one before, 5");
  write("a.bty", "'L'\n3\n0 90\n5 0\n6 70\n");
  expect_complaint(sloping, "a.bty:4: depth in m = 0: must be above 0, but for the last, a shore");
  const std::string wide = with(kBellhop, "'CVW'", "'QVW'");
  write("a.ssp", "2\n0 5\n1500 1500\n1490 1490\n");
  expect_complaint(wide, "a.ssp:4: sound speeds at 100 m = nothing: the file ends too early");
}

}  // namespace
}  // namespace earshot::ocean::acoustics_toolbox
