#include "policy/tables/ocean_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "policy/tables/merge.hpp"
#include "sim/field_library/store.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/search/known_ocean.hpp"
#include "sim/sonar/sonar_field.hpp"
#include "tests/sim/sonar/hilly_ocean.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::tables {
namespace {

constexpr CurvePlan kUsual{.vehicle_depth = Meters{300.0}, .range_step = Meters{100.0}, .range_count = 355, .bearings = 4};

BelievedOcean ocean_of(const std::string& file) {
  return oceans_in(EARSHOT_SOURCE_DIR "/" + file).front();
}

/// Whoever is told of an ocean, and whoever has tables of it, believes in the same one.
TEST(OceanCurve, OfThePapersOceanIsWhatABeliefIsToldOfIt) {
  const std::vector<OceanCurve> curves = curves_of(ocean_of("sim/ocean/environments/munk_flat.toml"), kUsual);
  ASSERT_EQ(curves.size(), 1U);
  const ocean::Environment environment = ocean::load_environment(EARSHOT_SOURCE_DIR "/sim/ocean/environments/munk_flat.toml");
  const auto told = std::make_unique<policy::OceanTables>();
  search::make_known_ocean({}, sonar::compute_snr_curve(environment, kUsual.vehicle_depth, search::furthest_range({})), *told);
  ASSERT_EQ(told->range_step, kUsual.range_step);
  ASSERT_EQ(told->range_count, kUsual.range_count);
  for (std::size_t i = 1; i < kUsual.range_count; ++i)  // at the source it is louder than a table holds
    EXPECT_NEAR(curves[0].snr_db[i], static_cast<double>(told->tables[0].snr_db(i)), 0.25 + 1e-5) << i;  // half decibels; floats
  EXPECT_EQ(curves[0].weight, 1.0);
  EXPECT_EQ(curves[0].sea_depth, Meters{3000.0});
  EXPECT_EQ(curves[0].source_depth, Meters{30.0});
}

TEST(OceanCurve, IsNoneWhereTheSeaFloorLiesAboveTheVehicle) {
  BelievedOcean ocean = ocean_of("policy/worlds/oceans/shallow.toml");  // 500 m
  CurvePlan plan = kUsual;
  plan.range_count = 11;
  plan.vehicle_depth = Meters{499.0};
  EXPECT_EQ(curves_of(ocean, plan).size(), 1U);
  plan.vehicle_depth = Meters{500.0};
  EXPECT_TRUE(curves_of(ocean, plan).empty());
}

/// A library of one position, four bearings, 100 m and 200 m of range at 300 m: the loss is 40 + 10 bearing + range dB (their indices);
/// on the last bearing there is no water.
BelievedOcean with_library(const std::filesystem::path& path) {
  BelievedOcean ocean = ocean_of("sim/ocean/environments/munk_flat.toml");
  const field_library::LibraryPlan plan{.name = "one",
                                        .environment = ocean.environment,
                                        .positions = {{Meters{5'000.0}, Meters{7'000.0}}},
                                        .centre = field_library::Centre::kSource,
                                        .fan = {.bearings = 4,
                                                .radial = {.source_depth = Meters{30.0},
                                                           .depth_m = {300.0},
                                                           .range_step = Meters{100.0},
                                                           .ranges = 2,
                                                           .band = {Hertz{20.0}, Hertz{20.0}}}},
                                        .file_crc32 = 1};
  const float no_water = std::nanf("");
  field_library::LibraryStore store(path, plan);
  store.write(0, std::vector<float>{40.0F, 41.0F, 50.0F, 51.0F, 60.0F, no_water, no_water, no_water});
  store.commit();
  ocean.field_library = path;
  return ocean;
}

TEST(OceanCurve, OfAFieldLibraryIsOneForEachBearingWithWater) {
  const support::TemporaryFolder folder;
  CurvePlan plan = kUsual;
  plan.range_count = 3;
  const std::vector<OceanCurve> curves = curves_of(with_library(folder / "library.nc"), plan);
  ASSERT_EQ(curves.size(), 3U);
  // SL - N = 100 dB; range 0 as at 100 m; where there is no water the loss is 300 dB.
  EXPECT_EQ(curves[0].snr_db, (std::vector<double>{60.0, 60.0, 59.0}));
  EXPECT_EQ(curves[1].snr_db, (std::vector<double>{50.0, 50.0, 49.0}));
  EXPECT_EQ(curves[2].snr_db, (std::vector<double>{40.0, 40.0, -200.0}));
  EXPECT_EQ(curves[0].detail, " 0 deg");
  EXPECT_EQ(curves[1].detail, " 90 deg");
  for (const OceanCurve& curve : curves) EXPECT_DOUBLE_EQ(curve.weight, 1.0 / 3.0);
}

TEST(OceanCurve, OfAFieldLibraryIsOfAsManyBearingsAsAreAskedFor) {
  const support::TemporaryFolder folder;
  CurvePlan plan = kUsual;
  plan.range_count = 3;
  plan.bearings = 2;
  const std::vector<OceanCurve> curves = curves_of(with_library(folder / "library.nc"), plan);
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[1].detail, " 180 deg");
  EXPECT_EQ(curves[1].snr_db.front(), 40.0);
}

/// An island in the east, the same north and south of the source.
TEST(OceanCurve, OfAChartIsOneForEachBearingAndSilentBehindAnIsland) {
  const support::TemporaryFolder folder;
  CurvePlan plan = kUsual;
  plan.range_count = 151;
  const std::vector<OceanCurve> curves = curves_of(oceans_in(tests::write_hilly_ocean(folder.path())).front(), plan);
  ASSERT_EQ(curves.size(), 4U);
  EXPECT_EQ(curves[1].detail, " 90 deg");
  constexpr double kMirrored_db = 0.01;  // the chart is the same on both sides
  EXPECT_LT(difference_db(curves[0].snr_db, curves[2].snr_db), kMirrored_db);
  EXPECT_GT(difference_db(curves[0].snr_db, curves[3].snr_db), 0.1);
  EXPECT_EQ(curves[1].snr_db[150], -200.0);  // at 15 km, the island stands at 7 km: 100 dB less 300 dB
  EXPECT_GT(curves[0].snr_db[150], -50.0);
}

/// The same island, 7 km east of the plane's origin and 12 km east of the source.
TEST(OceanCurve, OfAChartIsOfTheBearingsFromTheSourceWhereverThatIs) {
  const support::TemporaryFolder folder;
  CurvePlan plan = kUsual;
  plan.range_count = 151;
  BelievedOcean ocean = oceans_in(tests::write_hilly_ocean(folder.path())).front();
  ocean.environment.source.position = {Meters{0.0}, Meters{-5'000.0}};
  const std::vector<OceanCurve> curves = curves_of(ocean, plan);
  ASSERT_EQ(curves.size(), 4U);
  EXPECT_GT(curves[1].snr_db[90], -50.0);  // 9 km
  EXPECT_EQ(curves[1].snr_db[150], -200.0);
}

TEST(OceanCurves, StandInTheOrderOfTheirOceansAndThoseWithoutWaterAreTold) {
  CurvePlan plan = kUsual;
  plan.range_count = 31;
  const BelievedOcean ocean = ocean_of("sim/ocean/environments/munk_flat.toml");
  const std::vector<OceanCurve> one = curves_of(ocean, plan);
  std::size_t told = 0;
  std::vector<std::string> dry;
  BelievedOcean shallow = ocean_of("policy/worlds/oceans/shallow.toml");
  shallow.environment.seabed.depth = Meters{200.0};
  double done = 0.0;
  const std::vector<OceanCurve> many = curves_of(
      {ocean, shallow, ocean}, plan,
      [&](double share) {
        ++told;
        done = share;
      },
      [&](const BelievedOcean& o) { dry.push_back(o.environment.name); });
  ASSERT_EQ(many.size(), 2U);
  EXPECT_EQ(many[0].snr_db, one[0].snr_db);
  EXPECT_EQ(many[1].snr_db, one[0].snr_db);
  EXPECT_EQ(told, 3U);
  EXPECT_EQ(done, 1.0);
  EXPECT_EQ(dry, (std::vector<std::string>{"500 m of water over mud"}));
}

}  // namespace
}  // namespace earshot::tables
