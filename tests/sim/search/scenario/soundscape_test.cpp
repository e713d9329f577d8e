#include "sim/search/scenario/soundscape.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/field_library/store.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "tests/firmware/place.hpp"
#include "tests/sim/search/scenario/scenario_rig.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::search {
namespace {

/// 50 dB of loss to the north, one more per kilometre; 80 dB to east, south and west.
SnrFan fan_at(NorthEast centre, double level_db) {
  SnrFan result{.fan = {.centre = centre,
                        .bearings = 4,
                        .ranges = 10,
                        .range_step = Meters{1'000.0},
                        .depth_m = {300.0},
                        .transmission_loss_db = std::vector<float>(40, 80.0F),
                        .sea_floor_depth_m = {}},
                .source_level = Decibels{level_db},
                .noise_level = Decibels{90.0}};
  for (std::size_t i = 0; i < 10; ++i) result.fan.transmission_loss_db[i] = 50.0F + static_cast<float>(i + 1);
  return result;
}

TEST(Soundscape, HearsDifferentlyByBearingWhereTheOceanDoes) {
  const Soundscape soundscape(sonar::SnrCurve(Meters{1'000.0}, {0.0F}), {fan_at(at(0, 0), 190.0)});
  const std::size_t field = soundscape.field_of(0, at(5'000, 5'000));
  EXPECT_EQ(soundscape.snr(field, at(5'000, 5'000), at(9'000, 5'000)), Decibels{190.0 - 54.0 - 90.0});  // 4 km north
  EXPECT_EQ(soundscape.snr(field, at(5'000, 5'000), at(1'000, 5'000)), Decibels{190.0 - 80.0 - 90.0});  // 4 km south
}

TEST(Soundscape, TakesTheFanNearestToTheSource) {
  const Soundscape soundscape(sonar::SnrCurve(Meters{1'000.0}, {0.0F}), {fan_at(at(0, 0), 190.0), fan_at(at(20'000, 0), 200.0)});
  EXPECT_EQ(soundscape.field_of(0, at(9'000, 0)), 0U);
  EXPECT_EQ(soundscape.field_of(0, at(11'000, 0)), 1U);
  EXPECT_EQ(soundscape.snr(1, at(11'000, 0), at(10'000, 0)), Decibels{200.0 - 80.0 - 90.0});
}

TEST(Soundscape, HearsNothingWhereThereIsNoWater) {
  const Soundscape soundscape(sonar::SnrCurve(Meters{1'000.0}, {0.0F}), {fan_at(at(0, 0), 190.0)});
  EXPECT_EQ(soundscape.snr(0, at(0, 0), at(50'000, 0)), Decibels{190.0 - 300.0 - 90.0});  // beyond the last range
}

TEST(Soundscape, DrawsAmongItsCurvesOnly) {
  EXPECT_EQ(Soundscape({sonar::SnrCurve(Meters{1.0}, {0.0F}), sonar::SnrCurve(Meters{1.0}, {0.0F})}).ocean_count(), 2U);
  EXPECT_EQ(Soundscape(sonar::SnrCurve(Meters{1.0}, {0.0F}), {fan_at(at(0, 0), 1.0), fan_at(at(1, 0), 1.0)}).ocean_count(), 1U);
}

TEST(SoundscapeOf, RefusesAnOtherOceanWhoseSeaFloorLiesAboveTheVehicle) {
  Scenario scenario{.environment = papers_ocean(), .other_oceans = {papers_ocean(), papers_ocean()}};
  EXPECT_EQ(soundscape_of(scenario, Meters{300.0}, Meters{200.0}).ocean_count(), 3U);
  scenario.other_oceans.back().seabed.depth = Meters{299.0};
  EXPECT_THROW((void)soundscape_of(scenario, Meters{300.0}, Meters{200.0}), std::invalid_argument);
}

/// A scenario whose field library is of one position, two bearings, 100 m and 200 m of range, 100 m and 300 m of depth; the loss is
/// 100 b + 10 r + d (their indices). Nothing is computed.
Scenario with_library(const std::filesystem::path& path, double source_depth_m, double frequency_hz,
                      const std::vector<float>& loss_db = {0.0F, 1.0F, 10.0F, 11.0F, 100.0F, 101.0F, 110.0F, 111.0F},
                      field_library::Centre centre = field_library::Centre::kSource) {
  const field_library::LibraryPlan plan{.name = "one",
                                        .environment = papers_ocean(),
                                        .positions = {{Meters{0.0}, Meters{0.0}}},
                                        .centre = centre,
                                        .fan = {.bearings = 2,
                                                .radial = {.source_depth = Meters{source_depth_m},
                                                           .depth_m = {100.0, 300.0},
                                                           .range_step = Meters{100.0},
                                                           .ranges = 2,
                                                           .band = {Hertz{frequency_hz}, Hertz{frequency_hz}}}},
                                        .file_crc32 = 1};
  field_library::LibraryStore store(path, plan);
  store.write(0, loss_db);
  store.commit();
  return {.environment = papers_ocean(), .field_library = path};
}

std::string complaint_of(const Scenario& scenario, Meters vehicle_depth = Meters{300.0}, Meters furthest = Meters{200.0}) {
  try {
    (void)soundscape_of(scenario, vehicle_depth, furthest);
  } catch (const host::BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(SoundscapeOf, TakesTheVehiclesDepthFromALibraryOfSeveral) {
  const support::TemporaryFolder folder;
  const Scenario scenario = with_library(folder / "library.nc", 30.0, 20.0);
  const Soundscape lower = soundscape_of(scenario, Meters{300.0}, Meters{200.0});
  EXPECT_EQ(lower.snr(0, at(0, 0), at(200, 0)), Decibels{190.0 - 11.0 - 90.0});
  EXPECT_EQ(lower.snr(0, at(0, 0), at(-100, 0)), Decibels{190.0 - 101.0 - 90.0});
  const Soundscape upper = soundscape_of(scenario, Meters{100.0}, Meters{200.0});
  EXPECT_EQ(upper.snr(0, at(0, 0), at(200, 0)), Decibels{190.0 - 10.0 - 90.0});
  EXPECT_EQ(upper.snr(0, at(0, 0), at(-100, 0)), Decibels{190.0 - 100.0 - 90.0});
}

TEST(SoundscapeOf, TakesALibraryWhoseDepthsDifferByLessThanHalfAMetre) {
  const support::TemporaryFolder folder;
  EXPECT_EQ(complaint_of(with_library(folder / "near.nc", 30.25, 20.0)), "");
  EXPECT_NE(complaint_of(with_library(folder / "half.nc", 30.5, 20.0)).find("has its sources at 30.5 m"), std::string::npos);
  const Scenario scenario = with_library(folder / "library.nc", 30.0, 20.0);
  EXPECT_NO_THROW((void)soundscape_of(scenario, Meters{299.75}, Meters{200.0}));
  EXPECT_THROW((void)soundscape_of(scenario, Meters{299.5}, Meters{200.0}), host::BadInput);
}

TEST(SoundscapeOf, RefusesALibraryAroundHydrophones) {
  const support::TemporaryFolder folder;
  const std::string complaint = complaint_of(with_library(
      folder / "library.nc", 30.0, 20.0, {0.0F, 1.0F, 10.0F, 11.0F, 100.0F, 101.0F, 110.0F, 111.0F}, field_library::Centre::kHydrophone));
  EXPECT_TRUE(support::has_line(complaint, {"library.nc", "not", "hydrophone", "positions"})) << complaint;
}

TEST(SoundscapeOf, RefusesALibraryWithoutTheVehiclesDepthOrThatDoesNotReachAsFar) {
  const support::TemporaryFolder folder;
  const Scenario scenario = with_library(folder / "library.nc", 30.0, 20.0);
  const std::string depth = complaint_of(scenario, Meters{200.0});
  EXPECT_TRUE(support::has_line(depth, {"library.nc", "no", "200.000000 m"})) << depth;
  const std::string range = complaint_of(scenario, Meters{300.0}, Meters{201.0});
  EXPECT_NE(range.find("library.nc: must extend to 201"), std::string::npos) << range;
}

TEST(SoundscapeOf, RefusesALibraryOfASourceAtAnotherDepthOrFrequency) {
  const support::TemporaryFolder folder;
  const std::string depth = complaint_of(with_library(folder / "deep.nc", 100.0, 20.0));
  EXPECT_TRUE(support::has_line(depth, {"100 m", "source.depth_m", "30"})) << depth;
  const std::string frequency = complaint_of(with_library(folder / "high.nc", 30.0, 50.0));
  EXPECT_TRUE(support::has_line(frequency, {"50 to 50 Hz", "source.frequency_hz", "20"})) << frequency;
}

TEST(SoundscapeOf, RefusesALibraryWithoutWaterAtTheVehiclesDepth) {
  const support::TemporaryFolder folder;
  const float none = std::numeric_limits<float>::quiet_NaN();
  const std::string complaint =
      complaint_of(with_library(folder / "shelf.nc", 30.0, 20.0, {0.0F, none, 10.0F, none, 100.0F, none, 110.0F, none}));
  EXPECT_TRUE(support::has_line(complaint, {"no", "vehicle's", "300 m", "values", "missing"})) << complaint;
}

}  // namespace
}  // namespace earshot::search
