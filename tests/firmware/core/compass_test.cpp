#include "firmware/core/compass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace earshot {
namespace {

using std::numbers::pi;

TEST(WrapToTwoPi, TurnsAnAngleLeftOfNorthOnceRound) {
  for (const double angle : {0.0, 0.1, 3.0, pi}) EXPECT_EQ(wrap_to_two_pi(Radians{angle}).value, angle);
  EXPECT_EQ(wrap_to_two_pi(Radians{-pi / 2}).value, 1.5 * pi);
  EXPECT_EQ(wrap_to_two_pi(Radians{-pi}).value, pi);
  EXPECT_EQ(wrap_to_two_pi(Radians{-4 * pi}).value, 0.0);
  EXPECT_NEAR(wrap_to_two_pi(Radians{4.0 + 200 * pi}).value, 4.0, 1.2e-13);  // the argument's own last place at 632
  EXPECT_EQ(wrap_to_two_pi(Radians{-1e-300}).value, 2 * pi);                 // the double next to it
}

TEST(WrapToTwoPi, OfWhatIsNotFiniteIsNan) {
  EXPECT_TRUE(std::isnan(wrap_to_two_pi(Radians{-std::numeric_limits<double>::infinity()}).value));
}

TEST(CompassDegrees, TurnClockwiseFromNorth) {
  EXPECT_DOUBLE_EQ(compass_degrees(Radians{pi / 2}), 90.0);
  EXPECT_DOUBLE_EQ(compass_degrees(Radians{-pi / 2}), 270.0);
  EXPECT_DOUBLE_EQ(compass_degrees(Radians{3 * pi}), 180.0);
  EXPECT_EQ(compass_degrees(Radians{-1e-300}), 0.0);
}

}  // namespace
}  // namespace earshot
