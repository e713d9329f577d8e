#include "firmware/policy/observation.hpp"

#include <gtest/gtest.h>

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

TEST(Observe, TakesOffTheOffsetBeforeItScales) {
  ObservationModel model;
  ASSERT_EQ(model.spec.push_back({.feature = Feature::kNorth, .age = 0, .offset = 100.0F, .scale = 0.5F}), Status::kOk);
  SearchMemory memory;
  memory.start(model, at(104, 7), {.snr = Decibels{0}});
  EXPECT_EQ(observed(memory, model), (std::vector{2.0F}));
}

}  // namespace
}  // namespace earshot::policy
