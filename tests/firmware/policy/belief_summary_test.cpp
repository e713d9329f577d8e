#include "firmware/policy/belief_summary.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace earshot::policy {
namespace {

/// Four cells of 1 km x 1 km, summed up by hand.
TEST(BeliefSummary, HasTheMomentsOfItsCells) {
  BeliefModel model;
  model.area_size = {.north = Meters{2'000}, .east = Meters{2'000}};
  model.cells_north = 2;
  model.cells_east = 2;
  const messages::BeliefSummary summary = summary_of(model, std::array{0.5F, 0.25F, 0.25F, 0.0F});
  EXPECT_EQ(summary.likeliest, (NorthEast{.north = Meters{500}, .east = Meters{500}}));
  EXPECT_EQ(summary.likeliest_share, 0.5F);
  EXPECT_EQ(summary.mean, (NorthEast{.north = Meters{750}, .east = Meters{750}}));
  EXPECT_NEAR(summary.spread.value, 1'000 * std::sqrt(2 * 0.25 * 0.75), 1e-9);  // of two coins that fall 1:3, rounded in double
  EXPECT_NEAR(summary.effective_cells, 1.0F / 0.375F, 1e-6F);                   // of 0.25 + 0.0625 + 0.0625
}

}  // namespace
}  // namespace earshot::policy
