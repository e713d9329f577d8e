#include "firmware/desk/checklist/budgets.hpp"

#include <gtest/gtest.h>

#include <string>

#include "firmware/host/mission/mission_file.hpp"

namespace earshot::board {
namespace {

// 100 steps of 1 km at 2 m/s, over ground at 1.6 m/s against 0.4 m/s. Home from the corner (25, 25) km to (2, 3) km: sqrt(23^2 + 22^2) km,
// through the water 1.25 times as far. At 0.6 % a kilometre.
TEST(Budgets, AreThoseOfTheMissionThatShips) {
  const config::Mission mission =
      host::load_mission(std::string(EARSHOT_SOURCE_DIR) + "/firmware/boards/linux/missions/fenced_search.toml").mission;
  EXPECT_DOUBLE_EQ(way_of_all_steps(mission).value, 100'000.0);
  EXPECT_DOUBLE_EQ(seconds_for_all_steps(mission), 50'000.0);
  EXPECT_DOUBLE_EQ(seconds_against_current(mission), 62'500.0);
  EXPECT_DOUBLE_EQ(percent_for_all_steps(mission), 60.0);
  EXPECT_NEAR(longest_way_home(mission).value, 31'827.7, 0.1);  // as it is printed here
  EXPECT_NEAR(percent_for_way_home(mission), 23.871, 0.001);    // likewise
}

}  // namespace
}  // namespace earshot::board
