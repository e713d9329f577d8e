#include "firmware/policy/ocean_belief/bearings.hpp"

#include <gtest/gtest.h>

#include <array>

namespace earshot::policy {
namespace {

/// Of two cells.
BeliefModel model_of_two() {
  BeliefModel model;
  model.area_size = {Meters{1'000.0}, Meters{2'000.0}};
  model.cells_north = 1;
  model.cells_east = 2;
  return model;
}

TEST(BearingSum, AddsLogWeightsAndKeepsTheHighestAtZero) {
  const BeliefModel model = model_of_two();
  BearingSum bearings;
  bearings.start(model);
  EXPECT_TRUE(bearings.is_empty());
  constexpr std::array<std::int16_t, 2> kFirst{-100, 0};
  constexpr std::array<std::int16_t, 2> kSecond{0, -50};
  bearings.add(model, {.by_cell = kFirst, .taken_off = 7});
  EXPECT_FALSE(bearings.is_empty());
  EXPECT_EQ(bearings.sum().scale, 0) << "the highest is 0 as it is";
  bearings.add(model, {.by_cell = kSecond, .taken_off = 7});
  EXPECT_EQ(bearings.sum().log_weights[0], -50);  // -100 + 0, and 0 - 50, are 50 below 0
  EXPECT_EQ(bearings.sum().log_weights[1], 0);
  EXPECT_EQ(bearings.sum().scale, -50);
}

TEST(BearingSum, ForgetsNoPlaceEntirely) {
  const BeliefModel model = model_of_two();
  BearingSum bearings;
  bearings.start(model);
  constexpr std::array<std::int16_t, 2> kWest{0, kForgotten};
  for (int i = 0; i < 3; ++i) bearings.add(model, {.by_cell = kWest, .taken_off = 0});
  EXPECT_EQ(bearings.sum().log_weights[1], kForgotten);
  bearings.start(model);
  EXPECT_TRUE(bearings.is_empty());
  EXPECT_EQ(bearings.sum().log_weights[1], 0);
}

TEST(BearingWeights, AreHighestInTheDirectionOfTheBearing) {
  const BeliefModel model = model_of_two();
  const messages::Bearing west{.direction = Radians{4.7124}, .deviation = Radians{0.1}};
  std::array<std::int16_t, 2> by_cell{};
  const Measurement measurement = measurement_of({Meters{500.0}, Meters{1'000.0}}, {.snr = Decibels{}, .bearing = west});
  const BearingWeights weights = find_bearing_weights(model, measurement, by_cell);
  EXPECT_EQ(weights.by_cell[0], 0);
  EXPECT_LT(weights.by_cell[1], -kOctave) << "which is only an outlier's place";
  EXPECT_GT(weights.taken_off, 0) << "in that direction it is likelier than any direction is to who knows nothing";
}

}  // namespace
}  // namespace earshot::policy
