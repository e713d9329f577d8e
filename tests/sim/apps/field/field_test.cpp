#include "firmware/host/toml/table_reader.hpp"
#include "tests/sim/apps/field/field_program.hpp"
#include "tests/sim/netcdf/kept_conventions.hpp"
#include "tests/sim/ocean/charts/chart_files.hpp"
#include "tests/sim/sonar/hilly_ocean.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::tests {
namespace {

/// The ocean of a file with the water of woa.nc beside it.
std::string with_atlas(const std::filesystem::path& ocean) {
  std::string text = read(ocean);
  const auto water = text.find("[water]");
  text.replace(water, text.find("[bathymetry]") - water, "[water]\nprofile = \"woa\"\ntemperature_file = \"woa.nc\"\nreach_km = 60.0\n");
  std::ofstream(ocean) << text;
  return ocean.string();
}

TEST_F(FieldProgram, WritesAFieldAndNothingElse) {
  ASSERT_EQ(run(kMunk + " -o " + output() + " --max-range-km 1 --depth 100 300"), 0) << errors();
  EXPECT_EQ(errors(), "");  // no progress bar into a file
  std::ifstream file(output(), std::ios::binary);
  std::string magic(4, ' ');
  file.read(magic.data(), 4);
  EXPECT_EQ(magic, "\x89HDF");  // NetCDF-4 is HDF5
}

TEST_F(FieldProgram, KeepsToTheConventionsInEachOfItsFiles) {
  const std::string small = " --force -o " + output() + " --max-range-km 1 --output-step-m 100 --receiver-depth-m 300";
  const std::string hilly = write_hilly_ocean(folder_).string();
  for (const std::string& shape : {kMunk + small, kMunk + small + " --band-hz 15 25 --frequencies 2",
                                   kMunk + small + " --radials 4 --map --fluctuation-db 6", hilly + small + " --radials 4 --map"}) {
    SCOPED_TRACE(shape);
    ASSERT_EQ(run(shape), 0) << errors();
    expect_kept_conventions(output());
  }
  EXPECT_TRUE(netcdf::Reader(output()).has_variable("local_plane"));
}

TEST_F(FieldProgram, DrawsAPictureWhenAsked) {
  const auto picture = folder_ / "out" / "field.svg";
  ASSERT_EQ(run(kMunk + " -o " + output() + " --max-range-km 1 --depth-spacing 100 --plot " + picture.string()), 0) << errors();
  EXPECT_NE(read(picture).find("<svg"), std::string::npos);
}

TEST_F(FieldProgram, DrawsCurvesOfLossAndSnrWhereThereIsOneDepth) {
  expect_drawn("--depth 300", {"transmission loss (dB re 1 m)", "SNR (dB)", "hydrophone at 300 m", "detection threshold, 10 dB"});
}

TEST_F(FieldProgram, DrawsACurveForEachOfFewDepthsThoughTheyLieUnequallyFarApart) {
  expect_drawn("--depth 20 100 2900",
               {"transmission loss (dB re 1 m)", "hydrophone at 20 m", "hydrophone at 100 m", "hydrophone at 2900 m"});
}

TEST_F(FieldProgram, TakesFinerDepthsInShallowWaterAndTenMetresElsewhere) {
  const std::string near = " -o " + output() + " --max-range-km 1 --output-step-m 500";
  ASSERT_EQ(run(ocean_with("[seabed]\ndepth_m = 3000.0", "[seabed]\ndepth_m = 120.0") + near), 0) << errors();
  EXPECT_TRUE(support::has_line(said(), {"field", "2 ranges", "1 km", "120 depths", "1 to 120 m"})) << said();
  ASSERT_EQ(run(kMunk + near), 0) << errors();
  EXPECT_NE(said().find("300 depths from 10 to 3000 m"), std::string::npos) << said();
}

TEST_F(FieldProgram, SaysOneDepthAsOneAndTheBandThatItComputes) {
  ASSERT_EQ(run(kMunk + " -o " + output() + " --max-range-km 1 --depth 300 --band-hz 15 30 --frequencies 2"), 0) << errors();
  EXPECT_NE(said().find(" km, at a depth of 300 m\n"), std::string::npos) << said();
  EXPECT_NE(said().find(", source of 15 to 30 Hz at "), std::string::npos) << said();
}

TEST_F(FieldProgram, RefusesAHydrophoneAtTheSurfaceWhereThereIsNoSound) {
  expect_refused(kMunk + " -o " + output() + " --depth 0 100", "--depth = 0: at the surface there is no sound");
  expect_refused(kMunk + " -o " + output() + " --radials 4 --receiver-depth-m 0", "--depth = 0: at the surface there is no sound");
}

TEST_F(FieldProgram, SaysThatGnuplotIsMissing) {
  // A picture of more data than a pipe holds: gnuplot's absence must not end the program by SIGPIPE.
  const auto picture = folder_ / "out" / "field.png";
  EXPECT_EQ(run(kMunk + " -o " + output() + " --max-range-km 5 --plot " + picture.string(), "PATH=/nowhere"), 2);
  EXPECT_TRUE(support::has_line(errors(), {"field.png", "cannot", "drawn", "not"})) << errors();
  EXPECT_FALSE(std::filesystem::exists(picture));
}

TEST_F(FieldProgram, LooksAsDeepAsASectionIsBetweenItsStations) {
  // 100 m at the source, 3000 m at 100 km, linear between: 825 m at 25 km, where no station stands.
  std::ofstream(folder_ / "section.csv") << "range_m,depth_m\n0,100\n100000,3000\n";
  const std::string ocean =
      ocean_with("[seabed]\ndepth_m = 3000.0", "[bathymetry]\nlayout = \"section_csv\"\nfile = \"section.csv\"\n[seabed]");
  EXPECT_EQ(run(ocean + " -o " + output() + " --radials 4 --receiver-depth-m 800"), 0) << errors();
  std::filesystem::remove(output());
  expect_refused(ocean + " -o " + output() + " --radials 4 --receiver-depth-m 850", "at its deepest 825 m");
  expect_refused(ocean + " -o " + output() + " --receiver-depth-m 850", "at its deepest 825 m");
}

TEST_F(FieldProgram, RefusesAMissingFile) {
  expect_refused("/nowhere/ocean.toml -o " + output(), "/nowhere/ocean.toml: no such file");
}

TEST_F(FieldProgram, RefusesAnUnknownKey) {
  expect_refused(ocean_with("frequency_hz", "frequency_khz") + " -o " + output(), "source.frequency_khz: unknown key");
}

TEST_F(FieldProgram, RefusesANegativeFrequency) {
  expect_refused(ocean_with("frequency_hz = 20.0", "frequency_hz = -20.0") + " -o " + output(), "source.frequency_hz = -20.0");
}

TEST_F(FieldProgram, RefusesASourceBelowTheBottom) {
  expect_refused(ocean_with("depth_m = 30.0", "depth_m = 3000.0") + " -o " + output(), "must be less than seabed.depth_m");
}

TEST_F(FieldProgram, RefusesAReceiverBelowTheBottom) {
  expect_refused(kMunk + " -o " + output() + " --depth 3001", "--depth = 3001: must be from 0 m to the sea floor, at its deepest 3000 m");
}

TEST_F(FieldProgram, RefusesAnOutputThatCannotBeWritten) {
  expect_refused(kMunk + " -o /nowhere/field.nc", "/nowhere/field.nc: cannot be written");
}

TEST_F(FieldProgram, LeavesAFileThatIsNoneOfItsOwnUnlessForced) {
  const std::string ocean = ocean_with("depth_m = 30.0", "depth_m = 31.0");
  const std::string before = read(ocean);
  const std::string small = " --max-range-km 1 --depth 100";
  for (const std::string& option : {" -o " + ocean, " -o " + output() + " --plot " + ocean + ".svg"}) {
    std::filesystem::copy_file(ocean, ocean + ".svg", std::filesystem::copy_options::overwrite_existing);
    expect_refused(kMunk + small + option, "is there already and is not");
    EXPECT_EQ(read(ocean), before);
    EXPECT_EQ(read(ocean + ".svg"), before);
  }
  EXPECT_EQ(run(kMunk + small + " --force -o " + ocean), 0) << errors();
  EXPECT_EQ(read(ocean).substr(1, 3), "HDF");
  EXPECT_EQ(run(kMunk + small + " -o " + ocean), 0) << errors();
}

TEST_F(FieldProgram, NeverReplacesAFileThatItReadsNotEvenWhenForced) {
  const auto ocean = write_hilly_ocean(folder_);
  const auto chart = folder_ / "chart.csv";
  const std::string before = read(ocean) + read(chart);
  const std::string small = ocean.string() + " --force --max-range-km 1 --output-step-m 100 ";
  std::filesystem::create_symlink(ocean, folder_ / "link.nc");
  std::filesystem::create_hard_link(chart, folder_ / "hard.svg");
  for (const std::string& shape : {small + "--depth-spacing 500 ", small + "--radials 4 --receiver-depth-m 300 --map "}) {
    expect_refused(shape + "-o " + ocean.string(), "ENVIRONMENT " + ocean.string() + ", --output " + ocean.string() + ": the same file");
    expect_refused(shape + "-o " + (folder_ / "link.nc").string(), "link.nc: the same file");
    expect_refused(shape + "-o " + chart.string(), "a file of ENVIRONMENT " + chart.string() + ", --output ");
    expect_refused(shape + "-o " + output() + " --plot " + (folder_ / "hard.svg").string(), "hard.svg: the same file");
  }
  expect_refused(small + "--depth-spacing 500 -o " + output() + ".svg --plot " + output() + ".svg",
                 "--output " + output() + ".svg, --plot");
  EXPECT_EQ(read(ocean) + read(chart), before);
}

/// A chart is a NetCDF file as the output is: it would have been replaced without --force.
TEST_F(FieldProgram, NeverReplacesAChartThatIsOfTheOutputsKind) {
  AtlasFile{.depth_m = {0.0, 500.0, 1500.0},
            .latitude_deg = axis(-1.5, 0.5, 7),
            .longitude_deg = axis(-1.5, 0.5, 7),
            .temperature_c = [](double z, double, double) { return 25.0 - 0.01 * z; },
            .salinity_psu = [](double, double, double) { return 35.0; }}
      .write(folder_ / "woa.nc");
  const std::string before = read(folder_ / "woa.nc");
  const std::string ocean = with_atlas(write_hilly_ocean(folder_));
  expect_refused(ocean + " -o " + (folder_ / "woa.nc").string() + " --max-range-km 1 --depth-spacing 500", "woa.nc: the same file");
  EXPECT_EQ(read(folder_ / "woa.nc"), before);
}

/// Nothing tells that the chart of another ocean is of use to somebody but that Earshot did not write it.
TEST_F(FieldProgram, LeavesANetcdfFileThatOthersWrote) {
  const std::filesystem::path chart = folder_ / "gebco.nc";
  AtlasFile{.depth_m = {0.0, 500.0},
            .latitude_deg = axis(-1.5, 0.5, 7),
            .longitude_deg = axis(-1.5, 0.5, 7),
            .temperature_c = [](double, double, double) { return 25.0; },
            .salinity_psu = [](double, double, double) { return 35.0; }}
      .write(chart);
  const std::string before = read(chart);
  const std::string small = kMunk + " --max-range-km 1 --depth 100 -o " + chart.string();
  expect_refused(small, "gebco.nc: is there already and is not a NetCDF file of Earshot; --force replaces it");
  EXPECT_EQ(read(chart), before);
  EXPECT_EQ(run(small + " --force"), 0) << errors();
  EXPECT_EQ(run(small), 0) << errors();
}

TEST_F(FieldProgram, LeavesAPipeAndFollowsASymbolicLink) {
  const std::filesystem::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string small = " --max-range-km 1 --depth 100";
  expect_refused(kMunk + small + " --force -o " + pipe.string(), "pipe: cannot be written: it is a pipe");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  std::filesystem::create_symlink("out/field.nc", folder_ / "link.nc");
  EXPECT_EQ(run(kMunk + small + " -o " + (folder_ / "link.nc").string()), 0) << errors();
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link.nc"));
  EXPECT_EQ(read(output()).substr(1, 3), "HDF");
}

TEST_F(FieldProgram, RefusesAPictureOfAnUnknownKindBeforeTheWork) {
  expect_refused(kMunk + " -o " + output() + " --max-range-km 1 --plot " + folder_.path().string() + "/out/field.jpeg",
                 "must end in .png or .svg");
}

TEST_F(FieldProgram, RefusesAnOptionOutOfItsRange) {
  expect_refused(kMunk + " -o " + output() + " --max-range-km=-1", "--max-range-km: -1: must be a number from 0.001 to 2000");
  expect_refused(kMunk + " -o " + output() + " --max-range-km nan", "--max-range-km: nan: must be a number from 0.001 to 2000");
  expect_refused(kMunk + " -o " + output() + " --radials 0 --depth 300", "--radials: 0: must be");
  expect_refused(kMunk + " -o " + output() + " --radials 99999999999999999999 --depth 300", "--radials: 99999999999999999999: must be");
}

TEST_F(FieldProgram, RefusesMoreThanMemoryHolds) {
  expect_refused(kMunk + " -o " + output() + " --max-range-km 2000 --output-step-m 0.01", "must not exceed 6.4e+07; take a longer step");
  expect_refused(kMunk + " -o " + output() + " --max-range-km 2000 --output-step-m 0.01 --radials 100000 --depth 300", "must not exceed");
}

TEST_F(FieldProgram, RefusesASolverThatCannotServe) {
  const auto refuse = [this](const std::string& option, const std::string& value) {
    expect_refused(kMunk + " -o " + output() + " --max-range-km 1 --depth 300 " + option + " " + value, option.substr(2));
  };
  for (const char* value : {"17", "1", "-1", "nan", "eight"}) refuse("--terms", value);
  for (const char* value : {"0", "-5", "nan", "inf"}) {
    for (const char* option : {"--range-step", "--depth-step", "--accuracy-db", "--absorber-wavelengths", "--output-step-m"})
      refuse(option, value);
  }
  refuse("--starter", "thomson");
}

TEST_F(FieldProgram, TakesEveryOptionOfTheSolver) {
  const std::string options = " --max-range-km 2 --depth 300 --range-step 20 --depth-step 5 --absorber-wavelengths 8 --accuracy-db 0.1";
  for (const char* terms : {"2", "4", "8", "13", "16"})  // RAM writes stale numbers at 13
    EXPECT_EQ(run(kMunk + " -o " + output() + options + " --terms " + terms), 0) << errors();
  EXPECT_EQ(run(kMunk + " -o " + output() + options + " --starter gaussian"), 0) << errors();
}

TEST_F(FieldProgram, HasNoSecondDepthAHairAboveTheSeaFloor) {
  ASSERT_EQ(run(kMunk + " -o " + output() + " --max-range-km 1 --output-step-m 500 --depth-spacing 0.1"), 0) << errors();
  EXPECT_NE(said().find("30000 depths from 0.1 to 3000 m"), std::string::npos) << said();
}

TEST_F(FieldProgram, RefusesTermsThatLetTheSoundGrow) {
  expect_refused(kMunk + " -o " + output() + " --output-step-m 1000 --max-range-km 8 --terms 2", "take more terms or a shorter range step");
}

TEST_F(FieldProgram, FollowsOneRadialOfAnOceanWithCharts) {
  const std::string ocean = write_hilly_ocean(folder_).string();
  ASSERT_EQ(run(ocean + " -o " + output() + " --bearing-deg 270 --max-range-km 10 --depth-spacing 100"), 0) << errors();
  EXPECT_NE(said().find("to 10 km"), std::string::npos) << said();
}

TEST_F(FieldProgram, ComputesAndDrawsADetectionMap) {
  const std::string ocean = write_hilly_ocean(folder_).string();
  const auto picture = folder_ / "out" / "map.png";
  ASSERT_EQ(
      run(ocean + " -o " + output() + " --radials 8 --receiver-depth-m 300 --max-range-km 5 --output-step-m 100 --map --map-intervals 20 " +
          "--fluctuation-db 6 --plot " + picture.string()),
      0)
      << errors();
  EXPECT_EQ(read(picture).substr(1, 3), "PNG");
}

TEST_F(FieldProgram, MakesOneMarchForAllBearingsOfAFlatOcean) {
  ASSERT_EQ(run(kMunk + " -o " + output() + " --radials 360 --receiver-depth-m 300 --max-range-km 5"), 0) << errors();
  EXPECT_NE(said().find("one march for all"), std::string::npos) << said();
}

TEST_F(FieldProgram, SaysWhereTheSourceIsHeardNowhereAndWhereMaybeFurtherThanWasComputed) {
  const std::string fan = kMunk + " -o " + output() + " --radials 4 --receiver-depth-m 300 --max-range-km 5 --detection-threshold-db ";
  ASSERT_EQ(run(fan + "190"), 0) << errors();
  EXPECT_TRUE(support::has_line(said(), {"heard", "300 m", "nowhere", "SNR", "below 190 dB"})) << said();
  EXPECT_NE(said().find(", source of 20 Hz at "), std::string::npos) << said();
  ASSERT_EQ(run(fan + "-100"), 0) << errors();
  EXPECT_TRUE(support::has_line(said(), {"heard", "300 m", "5 km"})) << said();
}

TEST_F(FieldProgram, SaysOneRangeWhereItIsTheSameOnEveryBearing) {
  ASSERT_EQ(run(kMunk + " -o " + output() + " --radials 4 --receiver-depth-m 300 --max-range-km 25 --detection-threshold-db 20"), 0)
      << errors();
  EXPECT_NE(said().find("heard:   at 300 m last at "), std::string::npos) << said();
  EXPECT_EQ(said().find(" to ", said().find("heard:")), std::string::npos) << said();
}

TEST_F(FieldProgram, ExplainsInItsMapTheLinesAloneThatAreThere) {
  const auto picture = folder_ / "out" / "map.svg";
  const std::string map = kMunk + " -o " + output() +
                          " --radials 4 --receiver-depth-m 300 --max-range-km 5 --map --map-intervals 20 --plot " + picture.string() +
                          " --detection-threshold-db ";
  ASSERT_EQ(run(map + "-100"), 0) << errors();
  EXPECT_NE(read(picture).find("heard as far as computed, 5 km"), std::string::npos);
  EXPECT_EQ(read(picture).find("heard nowhere"), std::string::npos);
  EXPECT_EQ(read(picture).find("heard at every range within"), std::string::npos);
  ASSERT_EQ(run(map + "190"), 0) << errors();
  EXPECT_NE(read(picture).find("heard nowhere<"), std::string::npos);
  EXPECT_EQ(read(picture).find("heard nowhere beyond"), std::string::npos);
  EXPECT_EQ(read(picture).find("heard at every range within"), std::string::npos);
  EXPECT_NE(read(picture).find("SNR does not fluctuate"), std::string::npos);
}

TEST_F(FieldProgram, SaysHowMuchAFinerGridChanges) {
  ASSERT_EQ(run(kMunk + " -o " + output() + " --max-range-km 5 --depth 300 --check --band-hz 15 30 --frequencies 3"), 0) << errors();
  EXPECT_NE(said().find("halved at 30 Hz: loss changes by 0.0"), std::string::npos) << said();
}

TEST_F(FieldProgram, RefusesARadialThatLeavesTheChart) {
  const std::string ocean = write_hilly_ocean(folder_).string();
  expect_refused(ocean + " -o " + output() + " --radials 4 --receiver-depth-m 300 --max-range-km 60", "chart.csv");
}

TEST_F(FieldProgram, RefusesARadialThatMeetsLandBeforeItsFirstRange) {
  const std::string ocean = write_hilly_ocean(folder_).string();  // an island 7 km in the east
  const std::string coarse = " -o " + output() + " --max-range-km 16 --output-step-m 8000 --depth-spacing 500";
  expect_refused(ocean + coarse + " --bearing-deg 90", "--bearing-deg = 90: meets land 5");
  EXPECT_EQ(run(ocean + coarse + " --bearing-deg 270"), 0) << errors();
}

TEST_F(FieldProgram, SaysFromWhereOnARadialThatMeetsLandHoldsNoNumber) {
  const std::string ocean = write_hilly_ocean(folder_).string();  // an island 7 km in the east
  ASSERT_EQ(run(ocean + " -o " + output() + " --max-range-km 16 --output-step-m 1000 --depth-spacing 500 --bearing-deg 90"), 0) << errors();
  EXPECT_NE(errors().find("warning: the bearing meets land 5"), std::string::npos) << errors();
  EXPECT_NE(errors().find("from there on the field holds no number"), std::string::npos) << errors();
}

TEST_F(FieldProgram, WarnsOfBearingsThatMeetLandBeforeTheFirstRange) {
  const std::string ocean = write_hilly_ocean(folder_).string();
  const std::string coarse = ocean + " -o " + output() + " --max-range-km 16 --output-step-m 8000 --receiver-depth-m 300";
  EXPECT_EQ(run(coarse + " --radials 4"), 0) << errors();
  EXPECT_TRUE(support::has_line(errors(), {"warning", "1", "4 bearings", "90 degrees", "8000 m"})) << errors();
}

TEST_F(FieldProgram, SaysInItsWarningAndInTheFileWhereMeasurementsOfTheWaterEnd) {
  AtlasFile{.depth_m = {0.0, 500.0, 1500.0},
            .latitude_deg = axis(-1.5, 0.5, 7),
            .longitude_deg = axis(-1.5, 0.5, 7),
            .temperature_c = [](double z, double, double) { return 25.0 - 0.01 * z; },
            .salinity_psu = [](double, double, double) { return 35.0; }}
      .write(folder_ / "woa.nc");
  const std::string ocean = with_atlas(write_hilly_ocean(folder_));
  const std::string end = "temperature and salinity end at 1500 m, the sea floor lies at 24";
  for (const char* shape : {" --bearing-deg 180 --depth-spacing 500", " --radials 2 --receiver-depth-m 300"}) {
    ASSERT_EQ(run(ocean + " -o " + output() + " --max-range-km 3" + shape), 0) << errors();
    EXPECT_NE(errors().find("earshot field: warning: "), std::string::npos) << errors();
    EXPECT_NE(errors().find(end), std::string::npos) << errors();
    EXPECT_NE(read(output()).find(end), std::string::npos) << "attribute unmeasured_water";
  }
}

TEST_F(FieldProgram, RefusesOptionsThatContradictEachOther) {
  expect_refused("-o " + output(), "ENVIRONMENT");
  expect_refused(kMunk + " -o " + output() + " --radials 8", "--radials needs --receiver-depth-m");
  expect_refused(kMunk + " -o " + output() + " --map --depth 300", "--map requires --radials");
  expect_refused(kMunk + " -o " + output() + " --band-hz 30 15", "--band-hz");
  expect_refused(kMunk + " -o " + output() + " --library l.toml", "ENVIRONMENT: not with --library");
  expect_refused("--library l.toml -o " + output() + " --accuracy-db 0.5", "--accuracy-db");
  expect_refused(kMunk + " -o " + output() + " --depth 300 100", "must increase");
  expect_refused(kMunk + " -o " + output() + " --fluctuation-db 6", "--fluctuation-db requires --radials");
  expect_refused(kMunk + " -o " + output() + " --frequencies 6", "--frequencies requires --band-hz");
}

TEST_F(FieldProgram, SaysThatTheDiskIsFullAndLeavesNothing) {
  const std::string limit = "ulimit -f 40; trap '' XFSZ;";  // 20 or 40 KiB, by the shell's unit; the field needs more
  EXPECT_EQ(run(kMunk + " -o " + output() + " --max-range-km 20", limit), 2);
  EXPECT_NE(errors().find("field.nc"), std::string::npos) << errors();
  EXPECT_TRUE(nothing_written());
}

}  // namespace
}  // namespace earshot::tests
