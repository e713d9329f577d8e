#include "sim/search/known_ocean.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "firmware/policy/ocean_belief/ocean_belief.hpp"
#include "sim/search/belief_model.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::search {
namespace {

std::unique_ptr<policy::OceanTables> told(const SearchSettings& settings, const sonar::SnrCurve& curve) {
  auto tables = std::make_unique<policy::OceanTables>();
  make_known_ocean(settings, curve, *tables);
  return tables;
}

SearchSettings in_area(double north_m, double east_m) {
  SearchSettings settings;
  settings.domain = {at(-500.0, 700.0), at(-500.0 + north_m, 700.0 + east_m)};
  return settings;
}

/// A decibel every 100 m, from 40 dB at the source on.
sonar::SnrCurve one_decibel_every_hundred_metres() {
  std::vector<float> snr_db;
  for (int i = 0; i <= 100; ++i) snr_db.push_back(40.0F - static_cast<float>(i));
  return sonar::SnrCurve(Meters{100.0}, snr_db);
}

TEST(KnownOcean, IsTheCurveEveryHundredMetresFromTheSourceToJustBeyondTheDiagonal) {
  const auto tables = told(in_area(3'000.0, 4'000.0), one_decibel_every_hundred_metres());
  EXPECT_EQ(tables->range_step, Meters{100.0});
  ASSERT_EQ(tables->range_count, 52);  // 0 m to 5000 m, and one more
  ASSERT_EQ(tables->tables.size(), 1U);
  for (std::size_t i = 0; i < 52; ++i) EXPECT_EQ(tables->tables[0].snr_db(i), 40.0F - static_cast<float>(i)) << i;
}

TEST(KnownOcean, IsInHalfDecibelsBetweenTheSamplesOfItsCurve) {
  // 20 dB falling to 17.7 dB in 1000 m: 0.23 dB every 100 m. By hand: 20, 19.77, 19.54, 19.31, 19.08, 18.85, ... to the nearest half.
  const auto tables = told(in_area(3'000.0, 4'000.0), sonar::SnrCurve(Meters{1'000.0}, {20.0F, 17.7F}));
  const std::vector<float> expected{20.0F, 20.0F, 19.5F, 19.5F, 19.0F, 19.0F, 18.5F, 18.5F, 18.0F, 18.0F, 17.5F};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(tables->tables[0].snr_db(i), expected[i]) << i;
  EXPECT_EQ(tables->tables[0].snr_db(51), 17.5F) << "beyond the curve's end as at its end";
}

TEST(KnownOcean, ReachesTheDiagonalOfEveryAreaInAsManyRangesAsFit) {
  for (const auto& [north_m, east_m] : {std::pair{25'000.0, 25'000.0}, std::pair{1'000.0, 1'000.0}, std::pair{100.0, 1'000'000.0},
                                        std::pair{1'000'000.0, 100.0}, std::pair{3'000.0, 400'000.0}, std::pair{499.0, 37'123.0}}) {
    const auto tables = told(in_area(north_m, east_m), one_decibel_every_hundred_metres());
    EXPECT_TRUE(policy::has_valid_shape(*tables)) << north_m << " x " << east_m;
    EXPECT_GE(policy::reach(*tables).value, (1.0 - 1e-9) * std::hypot(north_m, east_m)) << north_m << " x " << east_m;  // rounding
  }
  // 40 km north, 250 km east: a diagonal of 253 180 m has 510 steps of 496.43 m.
  const auto large = told(in_area(40'000.0, 250'000.0), one_decibel_every_hundred_metres());
  EXPECT_NEAR(large->range_step.value, 496.431, 1e-3);  // as printed above
  EXPECT_EQ(large->range_count, 512);
}

TEST(KnownOcean, TakesThePlaceOfWhateverTheTablesHeld) {
  auto tables = told(in_area(40'000.0, 250'000.0), sonar::SnrCurve(Meters{100.0}, {-60.0F}));
  make_known_ocean(in_area(3'000.0, 4'000.0), one_decibel_every_hundred_metres(), *tables);
  ASSERT_EQ(tables->tables.size(), 1U);
  EXPECT_EQ(tables->range_count, 52);
  EXPECT_EQ(tables->tables[0].snr_db(0), 40.0F);
  EXPECT_EQ(std::string(tables->tables[0].name.begin(), tables->tables[0].name.end()), "told");
}

/// In an area of 100 km, where the ranges are 277 m apart, ten measurements in an ocean that falls by 1 dB a kilometre, from two tracks.
TEST(KnownOcean, LeadsABeliefToTheSourceHoweverFarApartItsRangesAre) {
  std::vector<float> snr_db;
  for (int km = 0; km <= 142; ++km) snr_db.push_back(40.0F - static_cast<float>(km));
  const sonar::SnrCurve curve(Meters{1'000.0}, snr_db);
  SearchSettings settings;
  settings.domain = {at(0.0, 0.0), at(100'000.0, 100'000.0)};
  const auto tables = told(settings, curve);
  ASSERT_GT(tables->range_step, Meters{277.0});
  const policy::BeliefModel model = belief_model(settings);
  const auto belief = std::make_unique<policy::OceanBelief>();
  belief->start(model, *tables);
  const NorthEast source = at(61'000.0, 71'000.0);
  for (int i = 0; i < 10; ++i) {
    const NorthEast place = i < 5 ? at(30'000.0 + 6'000.0 * i, 40'000.0) : at(54'000.0, 40'000.0 + 5'000.0 * (i - 4));
    belief->update(model, *tables, place, {.snr = curve.at(range_between(place, source))});
  }
  EXPECT_LT(range_between(belief->summary().likeliest, source).value, 3'000.0);  // a cell has 2 km
}

TEST(KnownOcean, CoversNoMissionForItNamesNeitherDepthNorFrequency) {
  const auto tables = told(SearchSettings{}, one_decibel_every_hundred_metres());
  EXPECT_FALSE(policy::are_usable(*tables, {.vehicle_depth = Meters{300.0}, .frequency = Hertz{20.0}, .furthest = Meters{1'000.0}}));
}

}  // namespace
}  // namespace earshot::search
