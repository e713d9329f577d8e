#include "firmware/policy/observation.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace earshot::policy {
namespace {

NorthEast at(double north, double east) {
  return {.north = Meters{north}, .east = Meters{east}};
}

std::vector<float> observed(const SearchMemory& memory, const ObservationSpec& spec) {
  std::vector<float> observation(spec.size());
  observe(memory, spec, observation);
  return observation;
}

ObservationSpec memory_of(std::size_t steps) {
  return memory_state(steps, Meters{1000}, Decibels{10}).value();
}

TEST(SimpleState, IsEastThenNorthScaledToOneAtTheEdges) {
  const ObservationSpec spec = simple_state(at(20000, 10000));
  SearchMemory memory;
  memory.start(at(0, 10000), Decibels{0});
  EXPECT_EQ(observed(memory, spec), (std::vector{1.0F, -1.0F}));
  memory.start(at(15000, 5000), Decibels{0});
  EXPECT_EQ(observed(memory, spec), (std::vector{0.0F, 0.5F}));
}

TEST(MemoryState, AtTheStartHoldsOnlyTheSnrHeardThere) {
  SearchMemory memory;
  memory.start(at(5000, 5000), Decibels{40});
  // SNR in units of 30 dB about the 10 dB threshold: 40 dB is 1, and the 0 dB of a step not yet taken is -1/3.
  EXPECT_EQ(observed(memory, memory_of(2)), (std::vector{0.0F, 0.0F, 1.0F, 0.0F, 0.0F, -1.0F / 3.0F}));
}

TEST(MemoryState, HoldsTheLastStepsNewestFirstEastBeforeNorth) {
  SearchMemory memory;
  memory.start(at(5000, 5000), Decibels{40});
  memory.remember(at(5500, 4000), Decibels{-20});
  memory.remember(at(4500, 4250), Decibels{10});
  EXPECT_EQ(observed(memory, memory_of(2)), (std::vector{0.25F, -1.0F, 0.0F, -1.0F, 0.5F, -1.0F}));
}

TEST(MemoryState, ForgetsStepsOlderThanItHolds) {
  SearchMemory memory;
  memory.start(at(0, 0), Decibels{40});
  for (int i = 1; i <= 30; ++i) memory.remember(at(0, 1000.0 * i), Decibels{10.0 + i});
  const std::vector<float> observation = observed(memory, memory_of(config::kMaxRememberedSteps));
  ASSERT_EQ(observation.size(), 3 * config::kMaxRememberedSteps);
  EXPECT_FLOAT_EQ(observation[2], 1.0F);                              // step 30: 40 dB
  EXPECT_FLOAT_EQ(observation[observation.size() - 1], 1.0F / 3.0F);  // step 10: 20 dB
}

TEST(MemoryState, ForgetsEverythingAtANewStart) {
  SearchMemory memory;
  memory.start(at(0, 0), Decibels{40});
  memory.remember(at(500, 500), Decibels{40});
  memory.start(at(9, 9), Decibels{10});
  EXPECT_EQ(observed(memory, memory_of(2)), (std::vector{0.0F, 0.0F, 0.0F, 0.0F, 0.0F, -1.0F / 3.0F}));
}

TEST(MemoryState, RefusesWhatItCannotHoldOrScale) {
  EXPECT_EQ(memory_state(0, Meters{1000}, Decibels{10}).status(), Status::kOutOfRange);
  EXPECT_EQ(memory_state(config::kMaxRememberedSteps + 1, Meters{1000}, Decibels{10}).status(), Status::kOutOfRange);
  EXPECT_EQ(memory_state(2, Meters{0}, Decibels{10}).status(), Status::kOutOfRange);
  EXPECT_EQ(memory_state(2, Meters{std::numeric_limits<double>::quiet_NaN()}, Decibels{10}).status(), Status::kOutOfRange);
  EXPECT_EQ(memory_state(2, Meters{1000}, Decibels{std::numeric_limits<double>::infinity()}).status(), Status::kOutOfRange);
}

TEST(Observe, TakesOffTheOffsetBeforeItScales) {
  ObservationSpec spec;
  ASSERT_EQ(spec.push_back({.feature = Feature::kNorth, .age = 0, .offset = 100.0F, .scale = 0.5F}), Status::kOk);
  SearchMemory memory;
  memory.start(at(104, 7), Decibels{0});
  EXPECT_EQ(observed(memory, spec), (std::vector{2.0F}));
}

}  // namespace
}  // namespace earshot::policy
