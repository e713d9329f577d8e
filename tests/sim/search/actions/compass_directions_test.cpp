#include "sim/search/actions/compass_directions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace earshot::search {
namespace {

TEST(CompassDirections, RunClockwiseFromNorthWithExactCardinals) {
  const ActionTable table = compass_directions(8);
  ASSERT_EQ(table.size(), 8U);
  EXPECT_EQ(table[0], (UnitNorthEast{1.0, 0.0}));
  EXPECT_EQ(table[2], (UnitNorthEast{0.0, 1.0}));
  EXPECT_EQ(table[4], (UnitNorthEast{-1.0, 0.0}));
  EXPECT_EQ(table[6], (UnitNorthEast{0.0, -1.0}));
  const double half = std::sqrt(0.5);
  EXPECT_NEAR(table[3].north, -half, 1e-12);  // south-east; core's sine is good to 1e-12
  EXPECT_NEAR(table[3].east, half, 1e-12);
}

TEST(CompassDirections, AreOfLengthOneForEveryCount) {
  for (std::size_t count = 1; count <= config::kMaxActions; ++count) {
    for (const UnitNorthEast& d : compass_directions(count)) EXPECT_NEAR(d.north * d.north + d.east * d.east, 1.0, 1e-12);  // as above
  }
}

TEST(CompassDirections, DivideTheCompassEvenlyWhateverTheirCount) {
  for (std::size_t count = 1; count <= config::kMaxActions; ++count) {
    const ActionTable table = compass_directions(count);
    ASSERT_EQ(table.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const double bearing = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(count);
      EXPECT_NEAR(table[i].north, std::cos(bearing), 1e-12) << i << " of " << count;  // as above
      EXPECT_NEAR(table[i].east, std::sin(bearing), 1e-12) << i << " of " << count;
    }
  }
}

}  // namespace
}  // namespace earshot::search
