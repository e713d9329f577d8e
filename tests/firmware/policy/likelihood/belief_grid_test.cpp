#include "firmware/policy/likelihood/belief_grid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/firmware/policy/belief/belief_rig.hpp"

namespace earshot::policy {
namespace {

constexpr Meters kSpacing{500};

/// 4 km x 9 km in 2 x 3 cells of 2 km x 3 km.
BeliefModel two_by_three() {
  return bare_model(at(4'000, 9'000), 2, 3);
}

TEST(BeliefGrid, HasCellsOfAShareOfItsArea) {
  EXPECT_EQ(cell_north(two_by_three()), 2'000.0);
  EXPECT_EQ(cell_east(two_by_three()), 3'000.0);
}

TEST(BeliefGrid, CountsTheRangeStepsInHalfOfTheLongerSideOfACell) {
  EXPECT_EQ(half_cell(two_by_three(), kSpacing, 100), 3U);
  EXPECT_EQ(half_cell(two_by_three(), kSpacing, 3), 2U);       // fewer than there are ranges
  EXPECT_EQ(half_cell(two_by_three(), Meters{751}, 100), 1U);  // 1.997: whole ones only
}

/// Of an area of 5 km x 4 km the corner that is furthest from (1000, 1000) m is 4 km north and 3 km east of it: 50 steps of 100 m. One more
/// sample is at no range, and one is for what is rounded.
TEST(BeliefGrid, CountsTheSamplesThatReachToEveryPlaceOfTheArea) {
  const BeliefModel model = bare_model(at(5'000, 4'000), 5, 4);
  EXPECT_EQ(ranges_to_all(model, at(1'000, 1'000), Meters{0}, Meters{100}, 1'000), 52U);
  EXPECT_EQ(ranges_to_all(model, at(4'000, 3'000), Meters{0}, Meters{100}, 1'000), 52U);
  EXPECT_EQ(ranges_to_all(model, at(1'000, 1'000), Meters{1'050}, Meters{100}, 1'000), 62U);
  EXPECT_EQ(ranges_to_all(model, at(-7'000, -1'000), Meters{0}, Meters{100}, 1'000), 132U) << "12 km and 5 km: 13 km";
  EXPECT_EQ(ranges_to_all(model, at(1'000, 1'000), Meters{0}, Meters{100}, 52), 52U);
  EXPECT_EQ(ranges_to_all(model, at(1'000, 1'000), Meters{0}, Meters{100}, 30), 30U) << "the tables have no more";
}

TEST(BeliefGrid, SmoothsOverTheNeighboursAndHoldsTheEnds) {
  const std::vector<float> values{6, 0, 0, 12, 0, 0, 0, 18};
  std::vector<float> smoothed(8);
  smooth(values, 1, smoothed);
  EXPECT_EQ(smoothed, (std::vector<float>{4, 2, 4, 4, 4, 0, 6, 12}));
  smooth(values, 0, smoothed);
  EXPECT_EQ(smoothed, values);
  const std::vector<float> few{3, 6};
  std::vector<float> of_few(2);
  smooth(few, 1, of_few);
  EXPECT_EQ(of_few, (std::vector<float>{4, 5}));
}

TEST(BeliefGrid, LeavesTheShareOfACellBeyondAStepAndNeverLessThanAThousandth) {
  BeliefModel model = two_by_three();
  model.step_length = Meters{2'000};
  std::array<float, 9> shares;
  find_uncovered(model, kSpacing, shares);  // of a cell 3 km long, every 500 m: half of one at a step's length
  const std::array<float, 9> expected{0.001F, 0.001F, 1.0F / 6, 2.0F / 6, 0.5F, 4.0F / 6, 5.0F / 6, 1, 1};
  for (std::size_t i = 0; i < 9; ++i) EXPECT_FLOAT_EQ(shares[i], expected[i]) << i;
}

}  // namespace
}  // namespace earshot::policy
