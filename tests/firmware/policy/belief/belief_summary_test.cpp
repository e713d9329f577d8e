#include "firmware/policy/belief/belief_summary.hpp"

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

/// Two rows of three cells, 1 km north by 3 km east each. Row 1 has 0.6: mean 0.6, variance 0.24 square cells; columns 1 and 2 have 0.4 and
/// 0.2: mean 0.8, variance 0.4 + 4 0.2 - 0.64 = 0.56.
TEST(BeliefSummary, HasTheMomentsOfCellsThatAreNotSquare) {
  BeliefModel model;
  model.area_size = {.north = Meters{2'000}, .east = Meters{9'000}};
  model.cells_north = 2;
  model.cells_east = 3;
  const messages::BeliefSummary summary = summary_of(model, std::array{0.1F, 0.2F, 0.1F, 0.3F, 0.2F, 0.1F});
  EXPECT_EQ(summary.likeliest, (NorthEast{.north = Meters{1'500}, .east = Meters{1'500}}));
  EXPECT_EQ(summary.likeliest_share, 0.3F);
  EXPECT_NEAR(summary.mean.north.value, 1'100, 1e-3);  // floats to seven places, as below
  EXPECT_NEAR(summary.mean.east.value, 3'900, 1e-3);
  EXPECT_NEAR(summary.spread.value, std::sqrt(0.24e6 + 0.56 * 9e6), 1e-3);
  EXPECT_NEAR(summary.effective_cells, 5.0F, 1e-5F);  // 1 / (0.01 + 0.04 + 0.01 + 0.09 + 0.04 + 0.01)
}

TEST(BeliefSummary, NamesTheFirstFromTheSouthWestOfCellsThatAreAsLikely) {
  BeliefModel model;
  model.area_size = {.north = Meters{2'000}, .east = Meters{9'000}};
  model.cells_north = 2;
  model.cells_east = 3;
  const messages::BeliefSummary summary = summary_of(model, std::array{0.25F, 0.25F, 0.0F, 0.25F, 0.25F, 0.0F});
  EXPECT_EQ(summary.likeliest, (NorthEast{.north = Meters{500}, .east = Meters{1'500}}));
}

}  // namespace
}  // namespace earshot::policy
