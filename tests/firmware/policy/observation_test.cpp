#include "firmware/policy/observation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace earshot::policy {
namespace {

NorthEast at(double north, double east) {
  return {.north = Meters{north}, .east = Meters{east}};
}

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
  memory.start(model, at(0, 10000), {.snr = Decibels{0}});
  EXPECT_EQ(observed(memory, model), (std::vector{1.0F, -1.0F}));
  memory.start(model, at(15000, 5000), {.snr = Decibels{0}});
  EXPECT_EQ(observed(memory, model), (std::vector{0.0F, 0.5F}));
}

TEST(MemoryState, AtTheStartHoldsOnlyTheSnrHeardThere) {
  const ObservationModel model = memory_of(2);
  SearchMemory memory;
  memory.start(model, at(5000, 5000), {.snr = Decibels{40}});
  // SNR in units of 30 dB about the 10 dB threshold: 40 dB is 1, and the 0 dB of a step not yet taken is -1/3.
  EXPECT_EQ(observed(memory, model), (std::vector{0.0F, 0.0F, 1.0F, 0.0F, 0.0F, -1.0F / 3.0F}));
}

TEST(MemoryState, HoldsTheLastStepsNewestFirstEastBeforeNorth) {
  const ObservationModel model = memory_of(2);
  SearchMemory memory;
  memory.start(model, at(5000, 5000), {.snr = Decibels{40}});
  memory.remember(model, at(5500, 4000), {.snr = Decibels{-20}});
  memory.remember(model, at(4500, 4250), {.snr = Decibels{10}});
  EXPECT_EQ(observed(memory, model), (std::vector{0.25F, -1.0F, 0.0F, -1.0F, 0.5F, -1.0F}));
}

TEST(MemoryState, ForgetsStepsOlderThanItHolds) {
  const ObservationModel model = memory_of(config::kMaxRememberedSteps);
  SearchMemory memory;
  memory.start(model, at(0, 0), {.snr = Decibels{40}});
  for (int i = 1; i <= 30; ++i) memory.remember(model, at(0, 1000.0 * i), {.snr = Decibels{10.0 + i}});
  const std::vector<float> observation = observed(memory, model);
  ASSERT_EQ(observation.size(), 3 * config::kMaxRememberedSteps);
  EXPECT_FLOAT_EQ(observation[2], 1.0F);                              // step 30: 40 dB
  EXPECT_FLOAT_EQ(observation[observation.size() - 1], 1.0F / 3.0F);  // step 10: 20 dB
}

TEST(MemoryState, ForgetsEverythingAtANewStart) {
  const ObservationModel model = memory_of(2);
  SearchMemory memory;
  memory.start(model, at(0, 0), {.snr = Decibels{40}});
  memory.remember(model, at(500, 500), {.snr = Decibels{40}});
  memory.start(model, at(9, 9), {.snr = Decibels{10}});
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
  memory.start(model, at(1000, 21000), {.snr = Decibels{0}});
  EXPECT_EQ(raw(memory, model, Feature::kToSouthEdge), 1000.0);
  EXPECT_EQ(raw(memory, model, Feature::kToNorthEdge), 24000.0);
  EXPECT_EQ(raw(memory, model, Feature::kToWestEdge), 21000.0);
  EXPECT_EQ(raw(memory, model, Feature::kToEastEdge), -1000.0);  // beyond it
}

/// Two actions, a signal that falls by 1 dB every kilometre.
ObservationModel believing_model() {
  ObservationModel model;
  BeliefModel& belief = model.belief;
  belief.area_size = at(10000, 10000);
  belief.cells_north = 20;
  belief.cells_east = 20;
  EXPECT_EQ(belief.actions.push_back({1, 0}), Status::kOk);
  EXPECT_EQ(belief.actions.push_back({0, 1}), Status::kOk);
  EXPECT_EQ(belief.hypotheses.push_back({.level_offset_db = 0.0F, .spread_db = 0.2F, .prior = 1.0F}), Status::kOk);
  for (int i = 0; i < 150; ++i) EXPECT_EQ(belief.snr_db.push_back(30.0F - 0.1F * static_cast<float>(i)), Status::kOk);
  model.spec = belief_state(belief);
  return model;
}

TEST(BeliefState, SeesTheSourceFromTheVehicleAndTheBestAction) {
  const ObservationModel model = believing_model();
  const NorthEast source = at(6250, 8250);
  const auto heard_at = [source](NorthEast place) {
    return Reception{.snr = Decibels{30.0 - range_between(place, source).value / 1000.0}};
  };
  SearchMemory memory;
  memory.start(model, at(1250, 2250), heard_at(at(1250, 2250)));
  for (const NorthEast place : {at(9000, 1000), at(500, 8000), at(6250, 2250)}) memory.remember(model, place, heard_at(place));
  EXPECT_EQ(raw(memory, model, Feature::kLikeliestEast), 6000.0);
  EXPECT_EQ(raw(memory, model, Feature::kLikeliestNorth), 0.0);
  EXPECT_NEAR(raw(memory, model, Feature::kMeanEast), 6000.0, 250.0);  // half a cell
  EXPECT_GT(raw(memory, model, Feature::kLikeliestShare), 0.3);
  EXPECT_EQ(raw(memory, model, Feature::kPreference, 1), 1.0);  // east
  EXPECT_LT(raw(memory, model, Feature::kPreference, 0), 1.0);
  EXPECT_NEAR(raw(memory, model, Feature::kApproach, 1), 1000.0, 1e-9);
  EXPECT_NEAR(raw(memory, model, Feature::kApproach, 0), -82.7625303, 1e-7);  // 6000 m - sqrt(6000^2 + 1000^2) m
  for (const float element : observed(memory, model)) EXPECT_LE(std::abs(element), 2.0F);
}

TEST(BeliefState, LeavesOutOfItsActionsWhatThereIsNoRoomFor) {
  BeliefModel belief = believing_model().belief;
  while (belief.actions.push_back({1, 0}) == Status::kOk) {
  }
  const ObservationSpec spec = belief_state(belief);
  EXPECT_LE(spec.size(), spec.capacity());
  EXPECT_EQ(std::ranges::count(spec, Feature::kPreference, &ObservationElement::feature), 32);
  EXPECT_EQ(std::ranges::count(spec, Feature::kReach, &ObservationElement::feature), 0);
}

TEST(SearchMemory, SpendsNothingOnABeliefThatNoElementSees) {
  ObservationModel model = believing_model();
  model.spec = simple_state(at(10000, 10000));
  SearchMemory memory;
  memory.start(model, at(5000, 5000), {.snr = Decibels{20}});
  EXPECT_EQ(memory.belief().summary().effective_cells, 0.0F) << "a belief was begun";
}

TEST(Observe, TakesOffTheOffsetBeforeItScales) {
  ObservationModel model;
  ASSERT_EQ(model.spec.push_back({.feature = Feature::kNorth, .age = 0, .offset = 100.0F, .scale = 0.5F}), Status::kOk);
  SearchMemory memory;
  memory.start(model, at(104, 7), {.snr = Decibels{0}});
  EXPECT_EQ(observed(memory, model), (std::vector{2.0F}));
}

}  // namespace
}  // namespace earshot::policy
