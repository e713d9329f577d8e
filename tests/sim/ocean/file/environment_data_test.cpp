#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "sim/ocean/charts/charts.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/ocean/section_along.hpp"
#include "tests/sim/ocean/charts/chart_files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::ocean {
namespace {

using tests::axis;

/// An environment file put together from its tables, beside the data files it names.
class EnvironmentData : public testing::Test {
 protected:
  Environment load() {
    std::ofstream(folder_ / "e.toml") << "name = \"e\"\n" << source << noise << origin << water << seabed << bathymetry;
    return load_environment(folder_ / "e.toml");
  }
  std::string complaint() {
    return tests::complaint_of([this] { (void)load(); });
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  void write_gebco(double depth_m) {
    tests::GebcoFile{axis(44, 0.25, 9), axis(-8, 0.25, 9), [=](double, double) { return -depth_m; }}.write(folder_ / "g.nc");
  }

  support::TemporaryFolder folder_;
  std::string source =
      "[source]\nfrequency_hz = 20.0\nlevel_db_re_1upa_at_1m = 190.0\ndepth_m = 30.0\nnorth_m = 10000.0\neast_m = 10000.0\n";
  std::string noise = "[noise]\nlevel_db_re_1upa = 90.0\n";
  std::string origin;
  std::string water = "[water]\nprofile = \"table\"\ndepth_m = [0.0, 5000.0]\nsound_speed_mps = [1500.0, 1550.0]\n";
  std::string seabed = "[seabed]\ndepth_m = 3000.0\n[[seabed.layers]]\nsound_speed_mps = 1600.0\n";
  std::string bathymetry;

  const std::string kOrigin = "[origin]\nlatitude_deg = 45.0\nlongitude_deg = -7.0\n";
  const std::string kGebco = "[bathymetry]\nlayout = \"gebco\"\nfile = \"g.nc\"\nreach_km = 60.0\n";
  const std::string kHalfSpace = "[seabed]\n[[seabed.layers]]\nsound_speed_mps = 1600.0\n";
};

void expect_mentions(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST_F(EnvironmentData, TakesAProfileFromACsvFileBesideIt) {
  water = "[water]\nprofile = \"csv\"\nfile = \"cast.csv\"\nformula = \"mackenzie\"\n";
  write("cast.csv", "depth_m,temperature_c,salinity_psu\n0,25,35\n1000,25,35\n4000,2,34.7\n");
  EXPECT_NEAR(sound_speed(load().water, Meters{1000.0}).value, 1550.744, 0.0005);  // Mackenzie's check value
}

TEST_F(EnvironmentData, TakesWaterThatChangesWithRangeFromKeysOrCsv) {
  water =
      "[water]\nprofile = \"table\"\n[[water.stations]]\nrange_m = 0.0\ndepth_m = [0.0, 3000.0]\nsound_speed_mps = [1500.0, 1500.0]\n"
      "[[water.stations]]\nrange_m = 10000.0\ndepth_m = [0.0, 3000.0]\nsound_speed_mps = [1520.0, 1520.0]\n";
  const Section from_keys = section_along(load(), {}, Radians{}, Meters{20'000.0});
  EXPECT_EQ(sound_speed(from_keys, Meters{5000.0}, Meters{100.0}), MetersPerSecond{1510.0});
  water = "[water]\nprofile = \"csv\"\nfile = \"w.csv\"\n";
  write("w.csv", "range_m,depth_m,sound_speed_mps\n0,0,1500\n0,3000,1500\n10000,0,1520\n10000,3000,1520\n");
  const Section from_csv = section_along(load(), {}, Radians{}, Meters{20'000.0});
  EXPECT_EQ(sound_speed(from_csv, Meters{5000.0}, Meters{100.0}), MetersPerSecond{1510.0});
}

TEST_F(EnvironmentData, TakesTheAsaWedgeFromASectionCsv) {
  source.replace(source.find("depth_m = 30.0"), 14, "depth_m = 100.0");
  seabed = kHalfSpace;
  bathymetry = "[bathymetry]\nlayout = \"section_csv\"\nfile = \"wedge.csv\"\n";
  write("wedge.csv", "range_m,depth_m\n0,200\n4000,0\n");
  const Environment wedge = load();
  EXPECT_EQ(wedge.seabed.depth, Meters{200.0});
  EXPECT_EQ(sea_floor_depth(section_along(wedge, {}, Radians{}, Meters{4000.0}), Meters{3000.0}), Meters{50.0});
}

TEST_F(EnvironmentData, TakesTheAsaWedgeFromTheFileItself) {
  source.replace(source.find("depth_m = 30.0"), 14, "depth_m = 100.0");
  seabed = kHalfSpace;
  bathymetry = "[bathymetry]\nlayout = \"section\"\nrange_m = [0, 4000]\ndepth_m = [200, 0]\n";
  const Environment wedge = load();
  EXPECT_EQ(wedge.seabed.depth, Meters{200.0});
  EXPECT_EQ(sea_floor_depth(section_along(wedge, {}, Radians{}, Meters{4000.0}), Meters{3000.0}), Meters{50.0});
  EXPECT_EQ(wedge.files.size(), 1U);
}

TEST_F(EnvironmentData, RefusesASectionThatIsNone) {
  seabed = kHalfSpace;
  const auto complaint_of_section = [this](const std::string& range_m, const std::string& depth_m) {
    bathymetry = "[bathymetry]\nlayout = \"section\"\nrange_m = " + range_m + "\ndepth_m = " + depth_m + "\n";
    return complaint();
  };
  const auto expect = [&](const std::string& range_m, const std::string& depth_m, const std::string& said) {
    EXPECT_NE(complaint_of_section(range_m, depth_m).find(said), std::string::npos) << complaint_of_section(range_m, depth_m);
  };
  expect("[]", "[]", "bathymetry.range_m: must hold one range or more");
  expect("[0, 1]", "[100]", "one for each of depth_m");
  expect("[0, 5, 5]", "[100, 90, 80]", "must increase: value number 3 does not");
  expect("[0, 1, 2]", "[100, 0, 100]", "value number 2 is not");
  expect("[0]", "[0]", "value number 1 is not");
  expect("[0, 1]", "[100, nan]", "must be a finite number");
}

TEST_F(EnvironmentData, ReadsAsTextWhatItReadsAsAFile) {
  const std::string text = "name = \"e\"\n" + source + noise + water + seabed;
  const Environment from_text = environment_of_text("text", text);
  const Environment from_file = load();
  EXPECT_EQ(from_text.name, "e");
  EXPECT_EQ(from_text.file_crc32, from_file.file_crc32);
  EXPECT_TRUE(from_text.files.empty());
  EXPECT_EQ(from_text.seabed.depth, from_file.seabed.depth);
  EXPECT_EQ(from_text.source.level, from_file.source.level);
}

TEST_F(EnvironmentData, TakesSeaFloorAndWaterFromCharts) {
  origin = kOrigin;
  seabed = kHalfSpace;
  bathymetry = kGebco;
  write_gebco(2500.0);
  tests::AtlasFile{.depth_m = {0.0, 1000.0},
                   .latitude_deg = axis(43.5, 0.5, 7),
                   .longitude_deg = axis(-8.5, 0.5, 7),
                   .temperature_c = [](double, double, double) { return 25.0; },
                   .salinity_psu = [](double, double, double) { return 35.0; }}
      .write(folder_ / "woa.nc");
  water = "[water]\nprofile = \"woa\"\ntemperature_file = \"woa.nc\"\nformula = \"mackenzie\"\nreach_km = 60.0\n";
  const Environment sea = load();
  EXPECT_EQ(sea.seabed.depth, Meters{2500.0});
  EXPECT_NEAR(sound_speed(sea.water, Meters{1000.0}).value, 1550.744, 0.001);
  std::set<std::string> names;
  for (const std::filesystem::path& file : sea.files) names.insert(file.filename());
  EXPECT_EQ(names, (std::set<std::string>{sea.files.front().filename(), "g.nc", "woa.nc"}));
  const Section section = section_along(sea, sea.source.position, Radians{1.0}, Meters{25'000.0});
  EXPECT_EQ(sea_floor_depth(section, Meters{20'000.0}), Meters{2500.0});
}

TEST_F(EnvironmentData, TakesSedimentThatChangesWithRange) {
  seabed =
      "[seabed]\ndepth_m = 3000.0\n"
      "[[seabed.stations]]\nrange_m = 0.0\n[[seabed.stations.layers]]\nsound_speed_mps = 1600.0\n"
      "[[seabed.stations]]\nrange_m = 8000.0\n[[seabed.stations.layers]]\nsound_speed_mps = 1700.0\n";
  const Section section = section_along(load(), {}, Radians{}, Meters{9000.0});
  EXPECT_EQ(sediment_at(section, Meters{2000.0}).layers[0].sound_speed, MetersPerSecond{1600.0});
  EXPECT_EQ(sediment_at(section, Meters{8500.0}).layers[0].sound_speed, MetersPerSecond{1700.0});
}

TEST_F(EnvironmentData, TakesNoiseFromWenzCurvesOrATableOverTheBand) {
  noise = "[noise]\nmodel = \"table\"\nfrequency_hz = [10.0]\nlevel_db_re_1upa2_per_hz = [80.0]\nband_hz = [15.0, 25.0]\n";
  EXPECT_NEAR(load().noise_level.value, 90.0, 1e-6);  // 80 + 10 lg 10
  noise = "[noise]\nmodel = \"wenz\"\nshipping = 0.5\nwind_speed_mps = 0.0\nrain = \"none\"\nband_hz = [99.5, 100.5]\n";
  EXPECT_NEAR(load().noise_level.value, 67.22, 0.01);  // worked by hand for 100 Hz in noise_test.cpp
  noise = "[noise]\nmodel = \"wenz\"\nshipping = 2.0\nwind_speed_mps = -1.0\nband_hz = [20.0, 10.0]\nrain = \"hail\"\n";
  const std::string all = complaint();
  expect_mentions(all, "noise.shipping = 2.0: must be a finite number of at least 0 and at most 1");
  expect_mentions(all, "noise.wind_speed_mps = -1.0");
  expect_mentions(all, "noise.band_hz: must be the lowest and the highest frequency");
  expect_mentions(all, "noise.rain = 'hail': must be one of \"none\", \"intermediate\", \"moderate\", \"heavy\"");
}

TEST_F(EnvironmentData, WorksOutAbsorptionAtTheSourcesFrequency) {
  EXPECT_EQ(load().absorption_db_per_km, 0.0);
  source.replace(source.find("20.0"), 4, "1000.0");
  origin = "[absorption]\ntemperature_c = 4.0\nsalinity_psu = 35.0\nacidity_ph_nbs = 8.0\ndepth_m = 1000.0\n";
  EXPECT_NEAR(load().absorption_db_per_km, 0.06103, 1e-5);  // arlpy 1.9.3
}

TEST_F(EnvironmentData, ChangesItsChecksumWithTheDataItNames) {
  water = "[water]\nprofile = \"csv\"\nfile = \"w.csv\"\n";
  write("w.csv", "depth_m,sound_speed_mps\n0,1500\n3000,1500\n");
  const auto before = load().file_crc32;
  EXPECT_EQ(load().file_crc32, before);
  EXPECT_EQ(load().files.back().filename(), "w.csv");
  write("w.csv", "depth_m,sound_speed_mps\n0,1500\n3000,1501\n");
  EXPECT_NE(load().file_crc32, before);
}

TEST_F(EnvironmentData, AsksForAnOriginBeforeItReadsCharts) {
  seabed = kHalfSpace;
  bathymetry = kGebco;
  expect_mentions(complaint(), "origin: must be there, with latitude_deg and longitude_deg");
}

TEST_F(EnvironmentData, RefusesTwoDepthsOfTheSeaFloor) {
  origin = kOrigin;
  bathymetry = kGebco;
  expect_mentions(complaint(), "seabed.depth_m = 3000.0: must be left out, [bathymetry] gives it");
}

TEST_F(EnvironmentData, RefusesASourceOnLandOrInTheSeaFloor) {
  origin = kOrigin;
  seabed = kHalfSpace;
  bathymetry = kGebco;
  write_gebco(-40.0);
  expect_mentions(complaint(), "is on land, 40 m above the sea surface");
  write_gebco(25.0);
  expect_mentions(complaint(), "e.toml: source.depth_m = 30: must be less than the depth of the sea floor at the source, 25 m");
}

TEST_F(EnvironmentData, RefusesAProfileThatEndsAboveTheSeaFloor) {
  origin = kOrigin;
  seabed = kHalfSpace;
  bathymetry = kGebco;
  write_gebco(6000.0);
  expect_mentions(complaint(), "the last depth_m of the sound-speed profile = 5000: must extend to the deepest sea floor, 6000 m");
}

TEST_F(EnvironmentData, NamesADataFileThatIsMissing) {
  water = "[water]\nprofile = \"csv\"\nfile = \"none.csv\"\n";
  expect_mentions(complaint(), "none.csv: no such file");
  origin = kOrigin;
  water = "[water]\nprofile = \"woa\"\ntemperature_file = \"none.nc\"\n";
  expect_mentions(complaint(), "none.nc: no such file");
}

TEST_F(EnvironmentData, HasRoomForTenThousandProfilesOfTheWater) {
  water = "[water]\nprofile = \"table\"\n";
  for (int i = 0; i <= 10'000; ++i)
    water += "[[water.stations]]\nrange_m = " + std::to_string(i) + "\ndepth_m = [0.0, 3000.0]\nsound_speed_mps = [1500.0, 1500.0]\n";
  expect_mentions(complaint(), "water.stations: has 10001 tables, must have at most 10000");
  water.erase(water.rfind("[[water.stations]]"));
  EXPECT_EQ(load().water_stations.size(), 10'000U);
}

TEST_F(EnvironmentData, RefusesSedimentStationsThatDoNotFollowEachOther) {
  seabed =
      "[seabed]\ndepth_m = 3000.0\n"
      "[[seabed.stations]]\nrange_m = 0.0\n[[seabed.stations.layers]]\nsound_speed_mps = 1600.0\n"
      "[[seabed.stations]]\nrange_m = 0.0\n[[seabed.stations.layers]]\nsound_speed_mps = 1700.0\n";
  expect_mentions(complaint(), "seabed.stations 2: range_m = 0.0: must be more than the station's before");
}

}  // namespace
}  // namespace earshot::ocean
