#include "firmware/policy/observation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/firmware/policy/ocean_belief/ocean_rig.hpp"

namespace earshot::policy {
namespace {

/// For observations that see no belief.
const OceanTables kNoOceans;

std::vector<float> observed(const SearchMemory& memory, const ObservationModel& model) {
  std::vector<float> observation(model.spec.size());
  observe(memory, model, observation);
  return observation;
}

ObservationModel memory_of(std::size_t steps) {
  return {.spec = memory_state(steps, Meters{1000}, Decibels{10}).value(), .belief = {}};
}

TEST(SimpleState, IsEastThenNorthScaledToOneAtTheEdges) {
  const ObservationModel model{.spec = simple_state(at(20000, 10000)), .belief = {}};
  SearchMemory memory;
  memory.start(model, kNoOceans, at(0, 10000), {.snr = Decibels{0}});
  EXPECT_EQ(observed(memory, model), (std::vector{1.0F, -1.0F}));
  memory.start(model, kNoOceans, at(15000, 5000), {.snr = Decibels{0}});
  EXPECT_EQ(observed(memory, model), (std::vector{0.0F, 0.5F}));
}

TEST(MemoryState, AtTheStartHoldsOnlyTheSnrHeardThere) {
  const ObservationModel model = memory_of(2);
  SearchMemory memory;
  memory.start(model, kNoOceans, at(5000, 5000), {.snr = Decibels{40}});
  // SNR in units of 30 dB about the 10 dB threshold: 40 dB is 1, and the 0 dB of a step not yet taken is -1/3.
  EXPECT_EQ(observed(memory, model), (std::vector{0.0F, 0.0F, 1.0F, 0.0F, 0.0F, -1.0F / 3.0F}));
}

TEST(MemoryState, HoldsTheLastStepsNewestFirstEastBeforeNorth) {
  const ObservationModel model = memory_of(2);
  SearchMemory memory;
  memory.start(model, kNoOceans, at(5000, 5000), {.snr = Decibels{40}});
  memory.remember(model, kNoOceans, at(5500, 4000), {.snr = Decibels{-20}});
  memory.remember(model, kNoOceans, at(4500, 4250), {.snr = Decibels{10}});
  EXPECT_EQ(observed(memory, model), (std::vector{0.25F, -1.0F, 0.0F, -1.0F, 0.5F, -1.0F}));
}

TEST(MemoryState, ForgetsStepsOlderThanItHolds) {
  const ObservationModel model = memory_of(config::kMaxRememberedSteps);
  SearchMemory memory;
  memory.start(model, kNoOceans, at(0, 0), {.snr = Decibels{40}});
  for (int i = 1; i <= 30; ++i) memory.remember(model, kNoOceans, at(0, 1000.0 * i), {.snr = Decibels{10.0 + i}});
  const std::vector<float> observation = observed(memory, model);
  ASSERT_EQ(observation.size(), 3 * config::kMaxRememberedSteps);
  EXPECT_FLOAT_EQ(observation[2], 1.0F);                              // step 30: 40 dB
  EXPECT_FLOAT_EQ(observation[observation.size() - 1], 1.0F / 3.0F);  // step 10: 20 dB
}

TEST(MemoryState, ForgetsEverythingAtANewStart) {
  const ObservationModel model = memory_of(2);
  SearchMemory memory;
  memory.start(model, kNoOceans, at(0, 0), {.snr = Decibels{40}});
  memory.remember(model, kNoOceans, at(500, 500), {.snr = Decibels{40}});
  memory.start(model, kNoOceans, at(9, 9), {.snr = Decibels{10}});
  EXPECT_EQ(observed(memory, model), (std::vector{0.0F, 0.0F, 0.0F, 0.0F, 0.0F, -1.0F / 3.0F}));
}

TEST(MemoryState, RefusesWhatItCannotHoldOrScale) {
  EXPECT_EQ(memory_state(0, Meters{1000}, Decibels{10}).status(), Status::kOutOfRange);
  EXPECT_EQ(memory_state(config::kMaxRememberedSteps + 1, Meters{1000}, Decibels{10}).status(), Status::kOutOfRange);
  EXPECT_EQ(memory_state(2, Meters{0}, Decibels{10}).status(), Status::kOutOfRange);
  EXPECT_EQ(memory_state(2, Meters{std::numeric_limits<double>::quiet_NaN()}, Decibels{10}).status(), Status::kOutOfRange);
  EXPECT_EQ(memory_state(2, Meters{1000}, Decibels{std::numeric_limits<double>::infinity()}).status(), Status::kOutOfRange);
}

double raw(const SearchMemory& memory, const ObservationModel& model, Feature feature, std::uint8_t index = 0) {
  return memory.raw(model, {.feature = feature, .age = index});
}

TEST(Edges, AreAsFarAsThePlaceInTheAreaSays) {
  ObservationModel model{.spec = simple_state(at(25000, 20000)), .belief = {}};
  model.belief.area_size = at(25000, 20000);
  SearchMemory memory;
  memory.start(model, kNoOceans, at(1000, 21000), {.snr = Decibels{0}});
  EXPECT_EQ(raw(memory, model, Feature::kToSouthEdge), 1000.0);
  EXPECT_EQ(raw(memory, model, Feature::kToNorthEdge), 24000.0);
  EXPECT_EQ(raw(memory, model, Feature::kToWestEdge), 21000.0);
  EXPECT_EQ(raw(memory, model, Feature::kToEastEdge), -1000.0);  // beyond it
}

/// Two actions.
ObservationModel believing_model() {
  ObservationModel model;
  BeliefModel& belief = model.belief;
  belief.area_size = at(10000, 10000);
  belief.cells_north = 20;
  belief.cells_east = 20;
  EXPECT_EQ(belief.actions.push_back({1, 0}), Status::kOk);
  EXPECT_EQ(belief.actions.push_back({0, 1}), Status::kOk);
  model.spec = belief_state(belief);
  return model;
}

/// Of the one ocean there is: 4 dB every kilometre.
double snr_db(double range_km) {
  return 40.0 - 4.0 * range_km;
}

OceanTables one_ocean() {
  OceanTables tables = no_tables(150);
  add_table(tables, 1.0F, snr_db);
  return tables;
}

TEST(BeliefState, SeesTheSourceFromTheVehicleAndTheBestAction) {
  const ObservationModel model = believing_model();
  const OceanTables tables = one_ocean();
  const NorthEast source = at(6250, 8250);
  const auto heard_at = [source](NorthEast place) {
    return Reception{.snr = Decibels{snr_db(range_between(place, source).value / 1000.0)}};
  };
  SearchMemory memory;
  memory.start(model, tables, at(1250, 2250), heard_at(at(1250, 2250)));
  for (const NorthEast place : {at(9000, 1000), at(500, 8000), at(6250, 2250)}) memory.remember(model, tables, place, heard_at(place));
  EXPECT_EQ(raw(memory, model, Feature::kLikeliestEast), 6000.0);
  EXPECT_EQ(raw(memory, model, Feature::kLikeliestNorth), 0.0);
  EXPECT_NEAR(raw(memory, model, Feature::kMeanEast), 6000.0, 250.0);  // half a cell
  EXPECT_GT(raw(memory, model, Feature::kLikeliestShare), 40.0 / 400.0) << "40 times what every cell has to begin with";
  EXPECT_EQ(raw(memory, model, Feature::kPreference, 1), 1.0);  // east
  EXPECT_LT(raw(memory, model, Feature::kPreference, 0), 1.0);
  EXPECT_NEAR(raw(memory, model, Feature::kApproach, 1), 1000.0, 1e-9);
  EXPECT_NEAR(raw(memory, model, Feature::kApproach, 0), -82.7625303, 1e-7);  // 6000 m - sqrt(6000^2 + 1000^2) m
  for (const float element : observed(memory, model)) EXPECT_LE(std::abs(element), 2.0F);
}

TEST(BeliefState, ShowsEveryNumberOfTheBeliefAsItIs) {
  const ObservationModel model = believing_model();
  const OceanTables tables = one_ocean();
  SearchMemory memory;
  memory.start(model, tables, at(1250, 2250), {.snr = Decibels{24}});
  const messages::BeliefSummary& summary = memory.belief().summary();
  EXPECT_EQ(raw(memory, model, Feature::kLikeliestEast), summary.likeliest.east.value - 2250);
  EXPECT_EQ(raw(memory, model, Feature::kLikeliestNorth), summary.likeliest.north.value - 1250);
  EXPECT_EQ(raw(memory, model, Feature::kMeanEast), summary.mean.east.value - 2250);
  EXPECT_EQ(raw(memory, model, Feature::kMeanNorth), summary.mean.north.value - 1250);
  EXPECT_EQ(raw(memory, model, Feature::kSpread), summary.spread.value);
  EXPECT_EQ(raw(memory, model, Feature::kLikeliestShare), double{summary.likeliest_share});
  EXPECT_EQ(raw(memory, model, Feature::kEffectiveCells), double{summary.effective_cells});
  for (std::uint8_t action = 0; action < 2; ++action) {
    const ActionValues& values = memory.belief().action_values(action);
    EXPECT_EQ(raw(memory, model, Feature::kFound, action), double{values.found});
    EXPECT_EQ(raw(memory, model, Feature::kFindProbability, action), double{values.find_probability});
    EXPECT_EQ(raw(memory, model, Feature::kDetected, action), double{values.detected});
    EXPECT_EQ(raw(memory, model, Feature::kBorder, action), double{values.border});
    EXPECT_EQ(raw(memory, model, Feature::kRegret, action), double{values.regret});
    EXPECT_EQ(raw(memory, model, Feature::kPreference, action), 1.0 / (1.0 + double{values.regret}));
  }
}

/// Of an area of 10 km x 20 km: distances to an edge about half of that side and in units of it, as are places of the source; the spread in
/// units of half of the north side, probabilities as they are, approaches in steps.
TEST(BeliefState, ScalesEveryElementToAboutOne) {
  BeliefModel belief = believing_model().belief;
  belief.area_size = at(10000, 20000);
  belief.step_length = Meters{500};
  const ObservationSpec spec = belief_state(belief);
  std::vector<ObservationElement> expected = {
      {Feature::kToSouthEdge, 0, 5000.0F, 1.0F / 5000.0F},  {Feature::kToNorthEdge, 0, 5000.0F, 1.0F / 5000.0F},
      {Feature::kToWestEdge, 0, 10000.0F, 1.0F / 10000.0F}, {Feature::kToEastEdge, 0, 10000.0F, 1.0F / 10000.0F},
      {Feature::kLikeliestEast, 0, 0.0F, 1.0F / 10000.0F},  {Feature::kMeanEast, 0, 0.0F, 1.0F / 10000.0F},
      {Feature::kLikeliestNorth, 0, 0.0F, 1.0F / 5000.0F},  {Feature::kMeanNorth, 0, 0.0F, 1.0F / 5000.0F},
      {Feature::kSpread, 0, 0.0F, 1.0F / 5000.0F},          {Feature::kLikeliestShare, 0, 0.0F, 1.0F}};
  for (const Feature feature :
       {Feature::kPreference, Feature::kFindProbability, Feature::kBorder, Feature::kDetected, Feature::kFound, Feature::kApproach}) {
    for (std::uint8_t action = 0; action < 2; ++action)
      expected.push_back({feature, action, 0.0F, feature == Feature::kApproach ? 1.0F / 500.0F : 1.0F});
  }
  EXPECT_TRUE(std::ranges::equal(spec, expected));
}

TEST(MemoryState, ScalesStepsShorterThanAMetreToo) {
  EXPECT_EQ(memory_state(1, Meters{0.5}, Decibels{10}).value()[0].scale, 2.0F);
}

TEST(MemoryState, HoldsForEveryStepEastNorthAndSnrInTheirUnits) {
  const ObservationSpec spec = memory_state(2, Meters{500}, Decibels{7}).value();
  const std::vector<ObservationElement> expected = {
      {Feature::kStepEast, 0, 0.0F, 1.0F / 500.0F},  {Feature::kStepNorth, 0, 0.0F, 1.0F / 500.0F},
      {Feature::kStepSnr, 0, 7.0F, 1.0F / 30.0F},    {Feature::kStepEast, 1, 0.0F, 1.0F / 500.0F},
      {Feature::kStepNorth, 1, 0.0F, 1.0F / 500.0F}, {Feature::kStepSnr, 1, 7.0F, 1.0F / 30.0F}};
  EXPECT_TRUE(std::ranges::equal(spec, expected));
}

TEST(SearchMemory, ForgetsItsBeliefAtANewStart) {
  const ObservationModel model = believing_model();
  const OceanTables tables = one_ocean();
  SearchMemory fresh;
  fresh.start(model, tables, at(5000, 5000), {.snr = Decibels{27}});
  SearchMemory used;
  used.start(model, tables, at(1000, 2000), {.snr = Decibels{22}});
  used.remember(model, tables, at(2000, 2000), {.snr = Decibels{23}});
  EXPECT_NE(used.belief().fingerprint(model.belief), fresh.belief().fingerprint(model.belief));
  used.start(model, tables, at(5000, 5000), {.snr = Decibels{27}});
  EXPECT_EQ(used.belief().fingerprint(model.belief), fresh.belief().fingerprint(model.belief));
}

TEST(BeliefState, LeavesOutOfItsActionsWhatThereIsNoRoomFor) {
  BeliefModel belief = believing_model().belief;
  while (belief.actions.push_back({1, 0}) == Status::kOk) {
  }
  const ObservationSpec spec = belief_state(belief);
  EXPECT_LE(spec.size(), spec.capacity());
  EXPECT_EQ(std::ranges::count(spec, Feature::kPreference, &ObservationElement::feature), 32);
  EXPECT_EQ(std::ranges::count(spec, Feature::kFindProbability, &ObservationElement::feature), 0);
}

TEST(BeliefState, FillsTheLastPlaceThereIs) {
  BeliefModel belief = believing_model().belief;
  while (belief.actions.size() < 9) EXPECT_EQ(belief.actions.push_back({1, 0}), Status::kOk);
  const ObservationSpec spec = belief_state(belief);  // 10 + 6 9 = 64
  EXPECT_EQ(spec.size(), 64U);
  EXPECT_EQ(std::ranges::count(spec, Feature::kApproach, &ObservationElement::feature), 9);
}

TEST(ObservationElement, ShowsARawValueAsItIsWhereNothingElseIsSaid) {
  EXPECT_EQ(scaled(ObservationElement{}, 7.5), 7.5F);
}

/// 23 was the probability of a hypothesis of the belief in one ocean: a policy that sees it is of another build.
TEST(Feature, IsUnknownWhereItsNumberBelongedToTheBeliefInOneOcean) {
  EXPECT_FALSE(is_known(Feature{23}));
  EXPECT_FALSE(needs_belief(Feature{23}));
}

/// 20 dB are heard at 5 km in the one ocean, and at 2 km in the other.
TEST(SearchMemory, BelievesByTheTablesThatItIsGiven) {
  const ObservationModel model = believing_model();
  OceanTables near = no_tables(150);
  add_table(near, 1.0F, [](double range_km) { return 40.0 - 10.0 * range_km; });
  const auto distance_believed = [&model](const OceanTables& tables) {
    SearchMemory memory;
    memory.start(model, tables, at(5000, 0), {.snr = Decibels{20}});
    return range_between(memory.belief().summary().likeliest, at(5000, 0)).value;
  };
  EXPECT_NEAR(distance_believed(one_ocean()), 5000.0, 500.0);
  EXPECT_NEAR(distance_believed(near), 2000.0, 500.0);
}

TEST(SearchMemory, SpendsNothingOnABeliefThatNoElementSees) {
  ObservationModel model = believing_model();
  model.spec = simple_state(at(10000, 10000));
  SearchMemory memory;
  memory.start(model, kNoOceans, at(5000, 5000), {.snr = Decibels{20}});
  EXPECT_EQ(memory.belief().summary().effective_cells, 0.0F) << "a belief was begun";
}

TEST(Observe, TakesOffTheOffsetBeforeItScales) {
  ObservationModel model;
  ASSERT_EQ(model.spec.push_back({.feature = Feature::kNorth, .age = 0, .offset = 100.0F, .scale = 0.5F}), Status::kOk);
  SearchMemory memory;
  memory.start(model, kNoOceans, at(104, 7), {.snr = Decibels{0}});
  EXPECT_EQ(observed(memory, model), (std::vector{2.0F}));
}

}  // namespace
}  // namespace earshot::policy
