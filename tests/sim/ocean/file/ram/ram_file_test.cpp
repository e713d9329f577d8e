#include "sim/ocean/file/ram/ram_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::ocean::ram {
namespace {

/// A file of RAM 1.5, a line each: a flat sea floor at 100 m, sediment that changes from 120 m down.
const std::string kFlat =
    "A flat sea floor\n"
    "100.0 30.0 50.0\n"
    "1000.0 10.0 2\n"
    "200.0 0.5 4 100.0\n"
    "1500.0 8 1 0.0\n"
    "0.0 100.0\n"
    "-1 -1\n"
    "0.0 1500.0\n"
    "100.0 1490.0\n"
    "-1 -1\n"
    "0.0 1600.0\n"
    "120.0 1600.0\n"
    "160.0 1700.0\n"
    "-1 -1\n"
    "0.0 1.5\n"
    "-1 -1\n"
    "0.0 0.5\n"
    "180.0 0.5\n"
    "200.0 10.0\n"
    "-1 -1\n";

class RamFile : public testing::Test {
 protected:
  [[nodiscard]] static std::string with(std::string text, const std::string& what, const std::string& by) {
    EXPECT_NE(text.find(what), std::string::npos) << what;
    return text.replace(text.find(what), what.size(), by);
  }
  [[nodiscard]] RadialCase load(const std::string& text) {
    std::ofstream(folder_ / "ram.in") << text;
    return load_ram(folder_ / "ram.in");
  }
  void expect_complaint(const std::string& text, const std::string& part) {
    try {
      (void)load(text);
      ADD_FAILURE() << "was read, in place of: " << part;
    } catch (const host::BadInput& bad) {
      EXPECT_NE(std::string(bad.what()).find(part), std::string::npos) << bad.what();
    }
  }

  const support::TemporaryFolder folder_;
};

TEST_F(RamFile, GivesOceanAndSource) {
  const Environment environment = load(kFlat).environment;
  EXPECT_EQ(environment.name, "A flat sea floor");
  EXPECT_EQ(environment.source.frequency, Hertz{100.0});
  EXPECT_EQ(environment.source.depth, Meters{30.0});
  EXPECT_EQ(environment.seabed.depth, Meters{100.0});
  EXPECT_EQ(std::get<TabulatedProfile>(environment.water).sound_speed_mps, (std::vector<double>{1500.0, 1490.0}));
  EXPECT_TRUE(environment.sea_floor_stations.empty());
  EXPECT_TRUE(environment.water_stations.empty());
  EXPECT_TRUE(environment.sediment_stations.empty());
}

TEST_F(RamFile, ShowsWhatOfItsTitleWouldSteerATerminal) {
  EXPECT_EQ(load(with(kFlat, "A flat", "A\x1b[31mflat")).environment.name, "A\\x1b[31mflat sea floor");
}

TEST_F(RamFile, MakesLayersBelowTheSeaFloorOfProfilesFromTheSurface) {
  const auto layers = load(kFlat).environment.seabed.layers;
  ASSERT_EQ(layers.size(), 5U);  // 100 to 120, 160, 180, 200 m, and below
  EXPECT_EQ(layers[0].thickness, Meters{20.0});
  EXPECT_FALSE(layers[0].sound_speed_at_base);
  EXPECT_EQ(layers[1].thickness, Meters{40.0});
  EXPECT_EQ(layers[1].sound_speed, MetersPerSecond{1600.0});
  EXPECT_EQ(layers[1].sound_speed_at_base, MetersPerSecond{1700.0});
  EXPECT_EQ(layers[3].attenuation_db_per_wavelength, 0.5);
  EXPECT_EQ(layers[3].attenuation_at_base_db_per_wavelength, 10.0);
  EXPECT_EQ(layers[4].attenuation_db_per_wavelength, 10.0);
  EXPECT_EQ(layers[4].density_g_per_cm3, 1.5);
}

TEST_F(RamFile, HasTheReceiversOfItsGrid) {
  // RAM writes nodes 4, 8, ... up to 100 / 0.5 - 0.5 = 199, of which the first is at the surface; and the ends of
  // steps 2, 4, ... up to 1000 m or beyond.
  const RadialCase read = load(kFlat);
  ASSERT_EQ(read.receiver_depth_m.size(), 49U);
  EXPECT_EQ(read.receiver_depth_m.front(), 1.5);
  EXPECT_EQ(read.receiver_depth_m.back(), 97.5);
  ASSERT_EQ(read.receiver_range_m.size(), 50U);
  EXPECT_EQ(read.receiver_range_m.front(), 20.0);
  EXPECT_EQ(read.receiver_range_m[1], 40.0);
  EXPECT_EQ(read.receiver_range_m.back(), 1000.0);
  EXPECT_EQ(load(with(kFlat, "0.5 4 100.0", "0.5 1 100.0")).receiver_depth_m.front(), 0.0);
}

TEST_F(RamFile, ChangesItsWaterWithinOneStepAtTheRangeOfNewProfiles) {
  const std::string two = kFlat + "500.0\n0.0 1480.0\n-1 -1\n0.0 1650.0\n-1 -1\n0.0 1.8\n-1 -1\n0.0 0.2\n-1 -1\n";
  const Environment environment = load(two).environment;
  ASSERT_EQ(environment.water_stations.size(), 3U);
  EXPECT_EQ(environment.water_stations[1].range, Meters{490.0});
  EXPECT_EQ(std::get<TabulatedProfile>(environment.water_stations[1].profile).sound_speed_mps.front(), 1500.0);
  EXPECT_EQ(environment.water_stations[2].range, Meters{500.0});
  EXPECT_EQ(std::get<TabulatedProfile>(environment.water_stations[2].profile).sound_speed_mps.front(), 1480.0);
  ASSERT_EQ(environment.sediment_stations.size(), 2U);
  EXPECT_EQ(environment.sediment_stations[1].range, Meters{500.0});
  EXPECT_EQ(environment.sediment_stations[1].layers.at(0).sound_speed, MetersPerSecond{1650.0});
}

TEST_F(RamFile, KeepsItsSedimentWhereItIsWhileTheSeaFloorRises) {
  // 40 m up over 1 km; the sediment begins to become faster at 120 m wherever the floor is.
  const Environment environment = load(with(kFlat, "0.0 100.0\n", "0.0 100.0\n1000.0 60.0\n")).environment;
  ASSERT_EQ(environment.sea_floor_stations.size(), 2U);
  ASSERT_EQ(environment.sediment_stations.size(), 54U);  // a twentieth of the wavelength, 0.75 m, at a time: 40 / 0.75 = 53.3
  for (std::size_t i = 0; i < 54; ++i) {
    const auto& station = environment.sediment_stations[i];
    EXPECT_NEAR(station.range.value, 1000.0 * static_cast<double>(i) / 54.0, 1e-9);
    const double floor_m = 100.0 - 40.0 * (static_cast<double>(i) + 0.5) / 54.0;  // in the middle of its stretch
    EXPECT_NEAR(station.layers.at(0).thickness.value, 120.0 - floor_m, 1e-9);
  }
}

TEST_F(RamFile, LetsUniformSedimentFollowTheSeaFloor) {
  const std::string uniform =
      with(with(with(kFlat, "120.0 1600.0\n160.0 1700.0\n", ""), "180.0 0.5\n200.0 10.0\n", ""), "0.0 100.0\n", "0.0 100.0\n900.0 60.0\n");
  const Environment environment = load(uniform).environment;
  EXPECT_TRUE(environment.sediment_stations.empty());
  ASSERT_EQ(environment.seabed.layers.size(), 1U);
  EXPECT_EQ(environment.seabed.layers[0].sound_speed, MetersPerSecond{1600.0});
}

TEST_F(RamFile, PutsTheSecondOfTwoEqualDepthsAStepFurtherDown) {
  const Environment environment = load(with(kFlat, "100.0 1490.0\n", "40.0 1495.0\n40.0 1485.0\n")).environment;
  EXPECT_EQ(std::get<TabulatedProfile>(environment.water).depth_m, (std::vector<double>{0.0, 40.0, 40.5}));
}

TEST_F(RamFile, RefusesWithItsLineWhatCannotBe) {
  expect_complaint(with(kFlat, "100.0 30.0 50.0", "100.0 130.0 50.0"), "source depth in m = 130: must be above the sea floor, at 100");
  expect_complaint(with(kFlat, "100.0 30.0 50.0", "0.1 30.0 50.0"), "ram.in:2: frequency in Hz = 0.1: must be");
  expect_complaint(with(kFlat, "1000.0 10.0 2", "1000.0 10.0 0"), "ram.in:3: ndr = 0: must be");
  expect_complaint(with(kFlat, "1000.0 10.0 2", "1000.0 10.0 1.5"), "ram.in:3: ndr = 1.5: must be a whole number");
  expect_complaint(with(kFlat, "1000.0 10.0 2", "1000.0 10.0 101"), "ram.in:3: ndr = 101: must not exceed the 100 steps up to rmax");
  expect_complaint(with(kFlat, "1000.0 10.0 2", "1e6 0.9 2"), "ram.in:3: rmax in m = 1e+06: must not be more than a million steps dr");
  expect_complaint(with(kFlat, "1500.0 8 1 0.0", "1500.0 8 1 /"), "ram.in:5: c0, np, ns and rs = 3 numbers: must be 4");
  expect_complaint(with(kFlat, "0.0 100.0\n", "10.0 100.0\n"), "ram.in:6: range of the sea floor in m = 10: the first must be 0");
  expect_complaint(with(kFlat, "0.0 100.0\n", "0.0 300.0\n"), "ram.in:6: depth of the sea floor in m = 300: must be");
  expect_complaint(with(kFlat, "160.0 1700.0", "110.0 1700.0"),
                   "ram.in:13: depth of sound speed of the sediment in m/s in m = 110: must be more");
  expect_complaint(with(kFlat, "200.0 10.0\n", "200.0 30.0\n"),
                   "ram.in:19: attenuation of the sediment in dB per wavelength = 30: must be");
  expect_complaint(with(kFlat, "0.5 4 100.0", "0.5 4 1.0"), "zmplt = 1: must hold one depth that is written, at least");
  expect_complaint(kFlat + "0\n", "ram.in:21: range of the next profiles in m = 0: must be more than that before");
}

TEST_F(RamFile, IsRefusedOrReadWhateverStandsInPlaceOfAWord) {
  const std::string two = kFlat + "500.0\n0.0 1480.0\n-1 -1\n0.0 1650.0\n-1 -1\n0.0 1.8\n-1 -1\n0.0 0.2\n-1 -1\n";
  std::size_t refused = 0;
  const auto expect_refused_or_sound = [&](const std::string& text) {
    try {
      for (const SedimentLayer& layer : load(text).environment.seabed.layers) {
        EXPECT_TRUE(std::isfinite(layer.sound_speed.value) && layer.thickness >= Meters{}) << text;
      }
    } catch (const host::BadInput& bad) {
      ++refused;
      EXPECT_TRUE(std::string(bad.what()).starts_with(folder_.path().string())) << bad.what();
    }
  };
  const std::string blanks = " \n";
  for (std::size_t from = two.find_first_not_of(blanks); from != std::string::npos;) {
    const std::size_t to = std::min(two.find_first_of(blanks, from), two.size());
    for (const std::string other : {"nan", "-1", "0", "1e18", "1e-9", "/", ",", "9*", "7*1.5", "'", "x"})
      expect_refused_or_sound(std::string(two).replace(from, to - from, other));
    expect_refused_or_sound(two.substr(0, from));
    from = two.find_first_not_of(blanks, to);
  }
  EXPECT_GE(refused, 300U);
}

}  // namespace
}  // namespace earshot::ocean::ram
