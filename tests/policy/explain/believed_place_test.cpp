#include "policy/explain/believed_place.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "sim/search/belief_model.hpp"

namespace earshot::explain {
namespace {

policy::BeliefModel model_of(std::vector<float> snr_db) {
  return search::belief_model(search::SearchSettings{}, sonar::SnrCurve(Meters{1'000.0}, std::move(snr_db)));
}

std::unique_ptr<policy::Belief> started(const policy::BeliefModel& model) {
  auto belief = std::make_unique<policy::Belief>();
  belief->start(model);
  return belief;
}

/// 40 dB at the source, 1 dB less every kilometre.
std::vector<float> falling() {
  std::vector<float> snr_db;
  for (int i = 0; i <= 36; ++i) snr_db.push_back(static_cast<float>(40 - i));
  return snr_db;
}

TEST(BelievedPlace, OfAUniformBeliefHasTheMomentsAndAreasOfASquare) {
  const policy::BeliefModel model = model_of(falling());
  const BelievedPlace place = believed_place(*started(model), model);
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
  const policy::BeliefModel model = model_of(falling());
  const auto belief = started(model);
  belief->update(model, {Meters{5'000.0}, Meters{6'000.0}}, {.snr = Decibels{34.0}});
  belief->update(model, {Meters{9'000.0}, Meters{6'000.0}}, {.snr = Decibels{31.0}});
  const BelievedPlace place = believed_place(*belief, model);
  const messages::BeliefSummary& summary = belief->summary();
  EXPECT_LE(range_between(place.mean, summary.mean).value, 5.0);  // a float sum over 2500 cells
  EXPECT_NEAR(std::hypot(place.ellipse.semi_major.value, place.ellipse.semi_minor.value), summary.spread.value,
              0.01 * summary.spread.value);
  EXPECT_NEAR(place.likeliest_share, static_cast<double>(summary.likeliest_share), 1e-5);
}

/// 34 dB is 6 km away; of the ring about a place on the west edge the eastern half is left, which is longer from south to north.
TEST(BelievedPlace, LiesAcrossTheBearingOfAHalfRing) {
  const policy::BeliefModel model = model_of(falling());
  const auto belief = started(model);
  belief->update(model, {Meters{12'500.0}, Meters{0.0}}, {.snr = Decibels{34.0}});
  const BelievedPlace place = believed_place(*belief, model);
  EXPECT_GT(place.ellipse.semi_major.value, 1.2 * place.ellipse.semi_minor.value);
  const double bearing = place.ellipse.bearing.value;
  EXPECT_LT(std::min(bearing, std::numbers::pi - bearing), 0.1);  // north and south
  EXPECT_LT(place.smallest_area_km2(0.5), place.smallest_area_km2(0.95));
}

TEST(ExpectedHearing, IsTheMeanOfTheTableOverTheCells) {
  policy::BeliefModel model = model_of({20.0F, 0.0F});
  model.area_size = {Meters{1'000.0}, Meters{2'000.0}};
  model.cells_north = 1;
  model.cells_east = 2;
  model.range_step = Meters{1'000.0};
  model.hypotheses.clear();
  model.snr_db.clear();
  for (const float snr : {20.0F, 0.0F}) (void)model.snr_db.push_back(snr);
  for (const float offset : {0.0F, 6.0F}) (void)model.hypotheses.push_back({.level_offset_db = offset});
  const auto belief = started(model);
  // Over the western cell: half the time it is there, at 20 dB, else a kilometre away at 0 dB; half the time 6 dB louder.
  const BelievedPlace place = believed_place(*belief, model);
  const NorthEast at{Meters{500.0}, Meters{500.0}};
  const ExpectedHearing hearing = expected_hearing(place, *belief, model, at);
  EXPECT_NEAR(hearing.snr.value, 13.0, 1e-9);
  EXPECT_NEAR(hearing.level_bias.value, 3.0, 1e-9);
  EXPECT_NEAR(hearing.spread.value, 10.0, 1e-9);
  // A step of 500 m east: half the time 500 m further away, half the time 500 m nearer.
  EXPECT_NEAR(expected_approach(place, at, {Meters{500.0}, Meters{1'000.0}}).value, 0.0, 1e-9);
  EXPECT_NEAR(expected_approach(place, at, {Meters{500.0}, Meters{2'500.0}}).value, -1'000.0, 1e-9);
}

}  // namespace
}  // namespace earshot::explain
