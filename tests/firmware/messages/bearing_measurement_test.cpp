#include "firmware/messages/bearing_measurement.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/not_finite.hpp"

namespace earshot::messages {
namespace {

using tests::kInfinity;
using tests::kNan;
constexpr double kFullTurn = 6.283185307179586;  // 2 pi, rounded to double
constexpr double kJustMore = 6.283185307179587;  // the double after it

bool is_possible_with(double direction, double deviation) {
  return is_possible(Bearing{.direction = Radians{direction}, .deviation = Radians{deviation}});
}

TEST(BearingMeasurement, IsPossibleInEveryDirectionOfTheCompass) {
  for (const double direction : {0.0, 1.0, 3.2, kFullTurn}) EXPECT_TRUE(is_possible_with(direction, 0.1)) << direction;
  for (const double direction : {-1e-9, kJustMore, 360.0, kNan, kInfinity, -kInfinity})
    EXPECT_FALSE(is_possible_with(direction, 0.1)) << direction;
}

TEST(BearingMeasurement, IsImpossibleWithoutAnUncertaintyOfUpToAHalfTurn) {
  for (const double deviation : {1e-9, 0.17, 3.141592653589793}) EXPECT_TRUE(is_possible_with(1.0, deviation)) << deviation;
  for (const double deviation : {0.0, -0.1, 3.1415926535897936, 10.0, kNan, kInfinity})
    EXPECT_FALSE(is_possible_with(1.0, deviation)) << deviation;
}

TEST(BearingMeasurement, IsImpossibleAboutAnAxisThatIsNone) {
  const auto about = [](double axis) {
    return is_possible(Bearing{.direction = Radians{1.0}, .deviation = Radians{0.1}, .mirror_axis = Radians{axis}});
  };
  for (const double axis : {0.0, 2.5, kFullTurn}) EXPECT_TRUE(about(axis)) << axis;
  for (const double axis : {-1e-9, kJustMore, kNan, kInfinity}) EXPECT_FALSE(about(axis)) << axis;
}

}  // namespace
}  // namespace earshot::messages
