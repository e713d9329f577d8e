#include "firmware/policy/belief_model.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/firmware/policy/belief_rig.hpp"

namespace earshot::policy {
namespace {

TEST(BeliefModel, HasAShapeThatFitsItsMemory) {
  BeliefModel model = flat_model({{0.0F, 2.0F, 1.0F}});
  EXPECT_TRUE(has_valid_shape(model));
  EXPECT_TRUE(has_valid_numbers(model));
  EXPECT_EQ(cell_count(model), 1'600U);
  model.cells_north = static_cast<std::uint16_t>(config::kMaxBeliefCells / 40 + 1);
  EXPECT_FALSE(has_valid_shape(model));
  model.cells_north = 0;
  EXPECT_FALSE(has_valid_shape(model));
  EXPECT_FALSE(has_valid_shape(flat_model({}))) << "no hypothesis";
}

TEST(BeliefModel, RefusesCostsThatNothingCouldBeDividedBy) {
  BeliefModel model = flat_model({{0.0F, 2.0F, 1.0F}});
  model.costs.reach = 0.0F;
  EXPECT_FALSE(has_valid_numbers(model));
  model.costs.reach = 30.0F;
  model.costs.log_step_discount = 0.0F;
  EXPECT_FALSE(has_valid_numbers(model));
}

TEST(BeliefModel, RefusesNumbersThatAreNone) {
  BeliefModel model = flat_model({{0.0F, 2.0F, 1.0F}});
  model.snr_db[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(has_valid_numbers(model));
}

}  // namespace
}  // namespace earshot::policy
