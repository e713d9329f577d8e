#include "firmware/policy/belief/belief_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/firmware/policy/belief/belief_rig.hpp"

namespace earshot::policy {
namespace {

/// 20 km x 20 km in cells of 500 m.
BeliefModel good_model() {
  return bare_model(at(20'000, 20'000), 40, 40);
}

TEST(BeliefModel, HasAShapeThatFitsItsMemory) {
  BeliefModel model = good_model();
  EXPECT_TRUE(has_valid_shape(model));
  EXPECT_TRUE(has_valid_numbers(model));
  EXPECT_EQ(cell_count(model), 1'600U);
  model.cells_north = static_cast<std::uint16_t>(config::kMaxBeliefCells / 40 + 1);
  EXPECT_FALSE(has_valid_shape(model));
  model.cells_north = 0;
  EXPECT_FALSE(has_valid_shape(model));
}

TEST(BeliefModel, RefusesCostsThatNothingCouldBeDividedBy) {
  BeliefModel model = good_model();
  model.costs.find_probability = 0.0F;
  EXPECT_FALSE(has_valid_numbers(model));
  model.costs.find_probability = 30.0F;
  model.costs.log_step_discount = 0.0F;
  EXPECT_FALSE(has_valid_numbers(model));
}

/// Every number at its limits, as its docstring says them, and a little beyond.
TEST(BeliefModel, LetsPassWhatIsInItsRangeAndNothingBeyond) {
  const auto is_valid_with = [](auto set, double value) {
    BeliefModel model = good_model();
    set(model, value);
    return has_valid_numbers(model);
  };
  const auto expect_range = [&is_valid_with](const char* what, double least, double most, auto set) {
    EXPECT_TRUE(is_valid_with(set, least)) << what;
    EXPECT_TRUE(is_valid_with(set, most)) << what;
    const double room = 1e-6 * (most - least);
    EXPECT_FALSE(is_valid_with(set, least - room)) << what;
    EXPECT_FALSE(is_valid_with(set, most + room)) << what;
    EXPECT_FALSE(is_valid_with(set, std::numeric_limits<double>::quiet_NaN())) << what;
  };
  const auto as_float = [](double x) { return static_cast<float>(x); };
  expect_range("area north", 1, 1e7, [](BeliefModel& m, double x) { m.area_size.north = Meters{x}; });
  expect_range("area east", 1, 1e7, [](BeliefModel& m, double x) { m.area_size.east = Meters{x}; });
  expect_range("step length", 1, 1e6, [](BeliefModel& m, double x) { m.step_length = Meters{x}; });
  expect_range("border", 1, 1e6, [](BeliefModel& m, double x) { m.border_width = Meters{x}; });
  expect_range("outliers", 0, 1, [=](BeliefModel& m, double x) { m.outlier_share = as_float(x); });
  expect_range("step", 0, 1e6, [=](BeliefModel& m, double x) { m.costs.step = as_float(x); });
  expect_range("reach's discount", 0, 1, [=](BeliefModel& m, double x) { m.costs.find_discount = as_float(x); });
  expect_range("edge", 0, 1e6, [=](BeliefModel& m, double x) { m.costs.edge = as_float(x); });
  expect_range("most regret", 0, 1e6, [=](BeliefModel& m, double x) { m.costs.most_regret = as_float(x); });
  // Limits that no float is, from either side.
  const auto discount = [=](BeliefModel& m, double x) { m.costs.log_step_discount = as_float(x); };
  const auto find_probability = [=](BeliefModel& m, double x) { m.costs.find_probability = as_float(x); };
  for (const double inside : {-10.0, -1.000001e-3}) EXPECT_TRUE(is_valid_with(discount, inside)) << inside;
  for (const double outside : {-10.00001, -0.999999e-3}) EXPECT_FALSE(is_valid_with(discount, outside)) << outside;
  for (const double inside : {1.000001e-3, 1e6}) EXPECT_TRUE(is_valid_with(find_probability, inside)) << inside;
  for (const double outside : {0.999999e-3, 1.000001e6}) EXPECT_FALSE(is_valid_with(find_probability, outside)) << outside;
}

/// As README.md of the folder says it and the paper's reward has it.
TEST(BeliefModel, IsThatOfThePapersSearchWhereNothingElseIsSaid) {
  const BeliefModel model;
  EXPECT_EQ(cell_count(model), 2'500U);
  EXPECT_EQ(model.step_length, Meters{1'000});
  EXPECT_EQ(model.border_width, Meters{1'000});
  EXPECT_EQ(model.detection_threshold, Decibels{10});
  EXPECT_EQ(model.outlier_share, 0.02F);
  EXPECT_EQ(model.costs.step, 3.0F);
  EXPECT_NEAR(std::exp(double{model.costs.log_step_discount}), 0.9, 1e-8);  // a float's seven places of 0.105
  EXPECT_EQ(model.costs.find_probability, 30.0F);
  EXPECT_EQ(model.costs.find_discount, 0.85F);
  EXPECT_EQ(model.costs.edge, 100.0F);
  EXPECT_EQ(model.costs.most_regret, 10.0F);
}

TEST(BeliefModel, RefusesAThresholdThatIsNone) {
  BeliefModel model = good_model();
  model.detection_threshold = Decibels{std::numeric_limits<double>::infinity()};
  EXPECT_FALSE(has_valid_numbers(model));
}

TEST(BeliefModel, HasNoShapeWithoutActionsOrColumns) {
  BeliefModel model = good_model();
  model.cells_east = 0;
  EXPECT_FALSE(has_valid_shape(model));
  model = good_model();
  model.actions.clear();
  EXPECT_FALSE(has_valid_shape(model));
  model = good_model();
  model.cells_north = 1;
  model.cells_east = static_cast<std::uint16_t>(config::kMaxBeliefCells);
  EXPECT_TRUE(has_valid_shape(model));
  model.cells_east = 1;
  EXPECT_TRUE(has_valid_shape(model));
}

}  // namespace
}  // namespace earshot::policy
