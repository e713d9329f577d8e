#include "policy/explain/believed_place.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "sim/search/belief_model.hpp"

namespace earshot::explain {
namespace {

/// Tables of one ocean, its ranges a kilometre apart.
std::unique_ptr<policy::OceanTables> ocean_of(const std::vector<float>& snr_db, float prior = 1.0F) {
  auto tables = std::make_unique<policy::OceanTables>();
  tables->range_step = Meters{1'000.0};
  tables->range_count = static_cast<std::uint16_t>(snr_db.size());
  policy::OceanTable ocean;
  ocean.prior = prior;
  for (std::size_t i = 0; i < snr_db.size(); ++i) ocean.snr_half_db[i] = policy::to_half_db(static_cast<double>(snr_db[i]));
  (void)tables->tables.push_back(ocean);
  return tables;
}

std::unique_ptr<policy::OceanBelief> started(const policy::BeliefModel& model, const policy::OceanTables& tables) {
  auto belief = std::make_unique<policy::OceanBelief>();
  belief->start(model, tables);
  return belief;
}

/// 40 dB at the source, 1 dB less every kilometre.
std::vector<float> falling() {
  std::vector<float> snr_db;
  for (int i = 0; i <= 36; ++i) snr_db.push_back(static_cast<float>(40 - i));
  return snr_db;
}

TEST(BelievedPlace, OfAUniformBeliefHasTheMomentsAndAreasOfASquare) {
  const policy::BeliefModel model = search::belief_model(search::SearchSettings{});
  const BelievedPlace place = believed_place(*started(model, *ocean_of(falling())), model);
  EXPECT_NEAR(place.mean.north.value, 12'500.0, 1e-6);
  EXPECT_NEAR(place.mean.east.value, 12'500.0, 1e-6);
  // n equal cells along a side of length a: variance (a^2 - (a/n)^2) / 12.
  const double deviation = std::sqrt((25'000.0 * 25'000.0 - 500.0 * 500.0) / 12.0);
  EXPECT_NEAR(place.ellipse.semi_major.value, deviation, 1e-3);
  EXPECT_NEAR(place.ellipse.semi_minor.value, deviation, 1e-3);
  EXPECT_NEAR(place.smallest_area_km2(0.5), 312.5, 0.26);  // half of 625 km^2, to one cell of 0.25 km^2
  EXPECT_NEAR(*std::ranges::max_element(place.rank), 1.0, 1e-9);
}

TEST(BelievedPlace, AgreesWithTheSummaryThatThePolicySees) {
  const policy::BeliefModel model = search::belief_model(search::SearchSettings{});
  const auto tables = ocean_of(falling());
  const auto belief = started(model, *tables);
  belief->update(model, *tables, {Meters{5'000.0}, Meters{6'000.0}}, {.snr = Decibels{34.0}});
  belief->update(model, *tables, {Meters{9'000.0}, Meters{6'000.0}}, {.snr = Decibels{31.0}});
  const BelievedPlace place = believed_place(*belief, model);
  const messages::BeliefSummary& summary = belief->summary();
  EXPECT_LE(range_between(place.mean, summary.mean).value, 5.0);  // a float sum over 2500 cells
  EXPECT_NEAR(std::hypot(place.ellipse.semi_major.value, place.ellipse.semi_minor.value), summary.spread.value,
              0.01 * summary.spread.value);
  EXPECT_NEAR(place.likeliest_share, static_cast<double>(summary.likeliest_share), 1e-5);
}

/// 34 dB is 6 km away; of the ring about a place on the west edge the eastern half is left, which is longer from south to north.
TEST(BelievedPlace, LiesAcrossTheBearingOfAHalfRing) {
  const policy::BeliefModel model = search::belief_model(search::SearchSettings{});
  const auto tables = ocean_of(falling());
  const auto belief = started(model, *tables);
  belief->update(model, *tables, {Meters{12'500.0}, Meters{0.0}}, {.snr = Decibels{34.0}});
  const BelievedPlace place = believed_place(*belief, model);
  EXPECT_GT(place.ellipse.semi_major.value, 1.2 * place.ellipse.semi_minor.value);
  const double bearing = place.ellipse.bearing.value;
  EXPECT_LT(std::min(bearing, std::numbers::pi - bearing), 0.1);  // north and south
  EXPECT_LT(place.smallest_area_km2(0.5), place.smallest_area_km2(0.95));
}

/// In the south-west corner a quarter of the ring is left, from north-west to south-east.
TEST(BelievedPlace, LiesAcrossTheBearingOfAQuarterRingOnItsOwnSideOfNorth) {
  const policy::BeliefModel model = search::belief_model(search::SearchSettings{});
  const auto tables = ocean_of(falling());
  const auto belief = started(model, *tables);
  belief->update(model, *tables, {}, {.snr = Decibels{34.0}});
  EXPECT_NEAR(believed_place(*belief, model).ellipse.bearing.value, 0.75 * std::numbers::pi, 1e-3);
}

TEST(BelievedPlace, IsLikeliestWhereThePolicySeesItInAnAreaThatIsNotSquareToo) {
  search::SearchSettings settings;
  settings.domain = {{}, {Meters{10'000.0}, Meters{25'000.0}}};
  const policy::BeliefModel model = search::belief_model(settings);
  ASSERT_NE(model.cells_north, model.cells_east);
  const auto tables = ocean_of(falling());
  const auto belief = started(model, *tables);
  // 6 km from each of two places and 7 km from the third: near 4 km north, 16 km east.
  belief->update(model, *tables, {Meters{4'000.0}, Meters{10'000.0}}, {.snr = Decibels{34.0}});
  belief->update(model, *tables, {Meters{4'000.0}, Meters{22'000.0}}, {.snr = Decibels{34.0}});
  belief->update(model, *tables, {Meters{0.0}, Meters{10'250.0}}, {.snr = Decibels{33.0}});
  const BelievedPlace place = believed_place(*belief, model);
  EXPECT_LE(range_between(place.likeliest, belief->summary().likeliest).value, 1.0);
  EXPECT_NEAR(place.likeliest.east.value, 16'000.0, 2'000.0);
}

TEST(ExpectedHearing, IsTheMeanOfTheTableOverTheCells) {
  policy::BeliefModel model = search::belief_model(search::SearchSettings{});
  model.area_size = {Meters{1'000.0}, Meters{2'000.0}};
  model.cells_north = 1;
  model.cells_east = 2;
  const auto tables = ocean_of({20.0F, 0.0F});
  const auto belief = started(model, *tables);
  // Over the western cell: half the time it is there, at 20 dB, else a kilometre away at 0 dB. Before a first measurement louder and
  // fainter sources are as likely.
  const BelievedPlace place = believed_place(*belief, model);
  const NorthEast at{Meters{500.0}, Meters{500.0}};
  const ExpectedHearing hearing = expected_hearing(place, ExpectedSound(*belief, *tables), at);
  EXPECT_NEAR(hearing.snr.value, 10.0, 1e-4);  // shares are floats
  EXPECT_NEAR(hearing.level_bias.value, 0.0, 1e-4);
  EXPECT_NEAR(hearing.spread.value, 10.0, 1e-4);
  // A step of 500 m east: half the time 500 m further away, half the time 500 m nearer.
  EXPECT_NEAR(expected_approach(place, at, {Meters{500.0}, Meters{1'000.0}}).value, 0.0, 1e-9);
  EXPECT_NEAR(expected_approach(place, at, {Meters{500.0}, Meters{2'500.0}}).value, -1'000.0, 1e-9);
}

TEST(ExpectedSound, IsTheStraightLineBetweenTwoRangesOfTheTablesAndTheLastBeyondThem) {
  const policy::BeliefModel model = search::belief_model(search::SearchSettings{});
  const auto tables = ocean_of({20.0F, 0.0F});
  const ExpectedSound sound(*started(model, *tables), *tables);
  EXPECT_NEAR(sound.snr_db(Meters{0.0}), 20.0, 1e-4);  // shares are floats
  EXPECT_NEAR(sound.snr_db(Meters{250.0}), 15.0, 1e-4);
  EXPECT_NEAR(sound.snr_db(Meters{1'000.0}), 0.0, 1e-4);
  EXPECT_NEAR(sound.snr_db(Meters{9'000.0}), 0.0, 1e-4);
}

/// One ocean of 20 dB everywhere; ten measurements of 26 dB leave hardly another explanation than a source 6 dB louder.
TEST(ExpectedSound, IsAsMuchLouderAsTheSourceIsBelievedToBe) {
  const policy::BeliefModel model = search::belief_model(search::SearchSettings{});
  const auto tables = ocean_of({20.0F, 20.0F});
  const auto belief = started(model, *tables);
  for (int i = 0; i < 10; ++i) belief->update(model, *tables, {Meters{5'000.0}, Meters{1'000.0 * i}}, {.snr = Decibels{26.0}});
  const ExpectedSound sound(*belief, *tables);
  EXPECT_NEAR(sound.level_db(), 6.0, 0.1);  // a measurement 3 dB off, of a spread of 2 dB, is a third as likely, ten of them 1e-5
  EXPECT_NEAR(sound.snr_db(Meters{500.0}), 20.0 + sound.level_db(), 1e-4);
}

/// Oceans of 20 and of 0 dB: the mean leans to the one whose share it is.
TEST(ExpectedSound, IsTheMeanOverTheOceansAsLikelyAsTheyAre) {
  const policy::BeliefModel model = search::belief_model(search::SearchSettings{});
  const auto tables = ocean_of({20.0F, 20.0F}, 3.0F);
  policy::OceanTable silent = tables->tables[0];
  silent.prior = 1.0F;
  silent.snr_half_db.fill(0);
  ASSERT_EQ(tables->tables.push_back(silent), Status::kOk);
  const auto belief = started(model, *tables);
  double of_the_loud = 0.0;
  for (std::size_t h = 0; h < policy::OceanBelief::kHypotheses; ++h)
    of_the_loud += belief->hypothesis(h).table == 0 ? static_cast<double>(belief->share(h)) : 0.0;
  ASSERT_GT(of_the_loud, 0.5);
  ASSERT_LT(of_the_loud, 0.95);
  const ExpectedSound sound(*belief, *tables);
  EXPECT_NEAR(sound.snr_db(Meters{500.0}) - sound.level_db(), 20.0 * of_the_loud, 1e-4);
}

}  // namespace
}  // namespace earshot::explain
