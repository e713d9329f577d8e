#include "sim/ocean/file/environment_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <variant>

#include "firmware/host/toml/table_reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::ocean {
namespace {

const std::string kShipped = std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml";

const std::string kSmall = R"(name = "small"
[source]
frequency_hz = 50.0
level_db_re_1upa_at_1m = 180.0
depth_m = 20.0
north_m = 1.0
east_m = 2.0
[noise]
level_db_re_1upa = 80.0
[water]
profile = "table"
depth_m = [0.0, 50.0, 100.0]
sound_speed_mps = [1500.0, 1490.0, 1495.0]
[seabed]
depth_m = 100.0
[[seabed.layers]]
thickness_m = 5.0
sound_speed_mps = 1550.0
[[seabed.layers]]
sound_speed_mps = 1700.0
density_g_per_cm3 = 2.0
attenuation_db_per_wavelength = 0.3
)";

class EnvironmentFile : public testing::Test {
 protected:
  Environment load(const std::string& text) {
    std::ofstream(path_) << text;
    return load_environment(path_);
  }
  /// `kSmall` with one part changed.
  Environment load_changed(const std::string& what, const std::string& by) {
    std::string text = kSmall;
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return load(text.replace(at, what.size(), by));
  }
  std::string complaint(const std::string& what, const std::string& by) {
    try {
      (void)load_changed(what, by);
    } catch (const host::BadInput& e) {
      return e.what();
    }
    return "";
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "environment.toml";
};

void expect_mentions(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST_F(EnvironmentFile, ShipsThePapersOcean) {
  const Environment ocean = load_environment(kShipped);
  EXPECT_EQ(ocean.source.frequency, Hertz{20.0});
  EXPECT_EQ(ocean.source.level, Decibels{190.0});
  EXPECT_EQ(ocean.source.depth, Meters{30.0});
  EXPECT_EQ(ocean.source.position, (NorthEast{Meters{10'000.0}, Meters{10'000.0}}));
  EXPECT_EQ(ocean.noise_level, Decibels{90.0});
  EXPECT_EQ(ocean.seabed.depth, Meters{3000.0});
  ASSERT_EQ(ocean.seabed.layers.size(), 1U);
  EXPECT_EQ(ocean.seabed.layers[0].sound_speed, MetersPerSecond{1505.0});
  const auto& munk = std::get<MunkProfile>(ocean.water);
  EXPECT_EQ(munk.axis_sound_speed, MetersPerSecond{1500.0});
  EXPECT_EQ(munk.perturbation, 0.00737);
}

TEST_F(EnvironmentFile, ReadsATableAndLayers) {
  const Environment ocean = load(kSmall);
  EXPECT_EQ(sound_speed(ocean.water, Meters{75.0}), MetersPerSecond{1492.5});
  ASSERT_EQ(ocean.seabed.layers.size(), 2U);
  EXPECT_EQ(ocean.seabed.layers[0].thickness, Meters{5.0});
  EXPECT_EQ(ocean.seabed.layers[1].density_g_per_cm3, 2.0);
  EXPECT_FALSE(ocean.seabed.layers[0].sound_speed_at_base);
}

TEST_F(EnvironmentFile, GivesALayerOfSedimentItsGradients) {
  const auto ocean = load_changed("thickness_m = 5.0",
                                  "thickness_m = 5.0\nsound_speed_at_base_mps = 1650.0\ndensity_at_base_g_per_cm3 = 1.8\n"
                                  "attenuation_at_base_db_per_wavelength = 0.2");
  const SedimentLayer& layer = ocean.seabed.layers.at(0);
  EXPECT_EQ(layer.sound_speed, MetersPerSecond{1550.0});
  EXPECT_EQ(layer.sound_speed_at_base, MetersPerSecond{1650.0});
  EXPECT_EQ(layer.density_at_base_g_per_cm3, 1.8);
  EXPECT_EQ(layer.attenuation_at_base_db_per_wavelength, 0.2);
}

TEST_F(EnvironmentFile, RefusesAGradientInTheHalfSpaceAndOneOutOfRange) {
  expect_mentions(complaint("density_g_per_cm3 = 2.0", "density_at_base_g_per_cm3 = 2.0"), "must be left out of the last layer");
  expect_mentions(complaint("thickness_m = 5.0", "thickness_m = 5.0\nsound_speed_at_base_mps = 1.7"), "sound_speed_at_base_mps = 1.7");
}

TEST_F(EnvironmentFile, KeepsTheChecksumOfItsBytes) {
  EXPECT_EQ(load(kSmall).file_crc32, 0xB5208706U);  // python3: zlib.crc32 of kSmall
}

TEST_F(EnvironmentFile, NamesAMissingFile) {
  EXPECT_THROW((void)load_environment("/nowhere/ocean.toml"), host::BadInput);
}

TEST_F(EnvironmentFile, RefusesANegativeFrequencyWithFileKeyValueAndRange) {
  const std::string text = complaint("frequency_hz = 50.0", "frequency_hz = -50.0");
  expect_mentions(text, path_.string() + ":3");
  expect_mentions(text, "source.frequency_hz = -50");
  expect_mentions(text, "at least 1 and at most 10000");
}

TEST_F(EnvironmentFile, RefusesASourceThatNoPlaneOnEarthReaches) {
  expect_mentions(complaint("north_m = 1.0", "north_m = 1e7"), "must be a finite number of at least -1000000 and at most 1000000");
  expect_mentions(complaint("east_m = 2.0", "east_m = -1e7"), "must be a finite number of at least -1000000 and at most 1000000");
}

TEST_F(EnvironmentFile, RefusesAnUnknownKey) {
  expect_mentions(complaint("north_m", "noth_m"), "source.noth_m: unknown key");
}

TEST_F(EnvironmentFile, SaysOneThingOfANumberThatIsNone) {
  const std::string changes[][3] = {
      {"50.0, 100.0]", "nan, 100.0]", ":12: water.depth_m[1] = nan: must be a finite number of at least 0 and at most 12000"},
      {"1490.0", "nan", ":13: water.sound_speed_mps[1] = nan: must be a finite number of at least 100 and at most 10000"},
      {"[1500.0, 1490.0, 1495.0]", "1500.0", ":13: water.sound_speed_mps = 1500.0: must be an array of numbers"},
      {"[0.0, 50.0, 100.0]", "100.0", ":12: water.depth_m = 100.0: must be an array of numbers"},
      {"depth_m = 20.0", "depth_m = nan", ":5: source.depth_m = nan: must be a finite number above 0 and at most 12000"},
      {"depth_m = 100.0", "depth_m = nan", ":15: seabed.depth_m = nan: must be a finite number above 0 and at most 12000"},
      {"level_db_re_1upa = 80.0",
       "model = \"table\"\nfrequency_hz = [10.0, nan]\nlevel_db_re_1upa2_per_hz = [80.0, 80.0]\nband_hz = [15.0, 25.0]",
       ":10: noise.frequency_hz[1] = nan: must be a finite number of at least 1 and at most 100000"},
      {"level_db_re_1upa = 80.0", "model = \"table\"\nfrequency_hz = [10.0]\nlevel_db_re_1upa2_per_hz = [80.0]\nband_hz = [nan, 25.0]",
       ":12: noise.band_hz[0] = nan: must be a finite number of at least 1 and at most 100000"},
  };
  for (const auto& [what, by, said] : changes) EXPECT_EQ(complaint(what, by), path_.string() + said);
}

TEST_F(EnvironmentFile, RefusesDepthsThatDoNotIncrease) {
  expect_mentions(complaint("[0.0, 50.0, 100.0]", "[0.0, 50.0, 50.0]"), "must increase: value number 3 does not");
}

TEST_F(EnvironmentFile, RefusesAProfileThatEndsAboveTheSeaFloor) {
  expect_mentions(complaint("[0.0, 50.0, 100.0]", "[0.0, 50.0, 90.0]"), "must extend from 0 to seabed.depth_m");
}

TEST_F(EnvironmentFile, RefusesTablesOfUnequalLength) {
  expect_mentions(complaint("1490.0, 1495.0", "1490.0"), "must have one for each of the 3 of depth_m");
}

TEST_F(EnvironmentFile, RefusesASourceBelowTheBottom) {
  expect_mentions(complaint("depth_m = 20.0", "depth_m = 100.0"), "source.depth_m = 100.0: must be less than seabed.depth_m");
}

TEST_F(EnvironmentFile, RefusesAHalfSpaceWithAThickness) {
  expect_mentions(complaint("sound_speed_mps = 1700.0", "sound_speed_mps = 1700.0\nthickness_m = 3.0"),
                  "must be left out of the last layer");
}

TEST_F(EnvironmentFile, ReportsAllProblemsAtOnce) {
  const std::string text =
      complaint("frequency_hz = 50.0\nlevel_db_re_1upa_at_1m = 180.0", "frequency_hz = 0.0\nlevel_db_re_1upa_at_1m = 900.0");
  expect_mentions(text, "frequency_hz");
  expect_mentions(text, "level_db_re_1upa_at_1m");
}

}  // namespace
}  // namespace earshot::ocean
