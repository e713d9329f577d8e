#include "firmware/core/geometry.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/firmware/place.hpp"

namespace earshot {
namespace {

TEST(LengthOf, IsTheHypotenuse) {
  EXPECT_EQ(length_of(at(3000, -4000)), Meters{5000});
  EXPECT_EQ(length_of(at(0, 0)), Meters{0});
  EXPECT_FALSE(length_of(at(std::numeric_limits<double>::quiet_NaN(), 0)) >= Meters{0});
}

TEST(NorthEast, IsFiniteWhenBothCoordinatesAre) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_finite(at(1e308, -1e308)));
  for (const double wrong : {kNan, kInfinity, -kInfinity}) {
    EXPECT_FALSE(is_finite(at(wrong, 0))) << wrong;
    EXPECT_FALSE(is_finite(at(0, wrong))) << wrong;
  }
}

TEST(RangeBetween, IsTheSameFromEitherEnd) {
  EXPECT_EQ(range_between(at(100, 200), at(-20, 250)), Meters{130});
  EXPECT_EQ(range_between(at(-20, 250), at(100, 200)), Meters{130});
}

const Rectangle kArea{.south_west = at(-10, 100), .north_east = at(30, 200)};

TEST(Rectangle, ContainsItsEdgesAndCornersAndNothingBeyond) {
  EXPECT_TRUE(kArea.contains(at(-10, 100)));
  EXPECT_TRUE(kArea.contains(at(30, 200)));
  EXPECT_FALSE(kArea.contains(at(-10.001, 150)));
  EXPECT_FALSE(kArea.contains(at(30.001, 150)));
  EXPECT_FALSE(kArea.contains(at(0, 99.999)));
  EXPECT_FALSE(kArea.contains(at(0, 200.001)));
}

TEST(Rectangle, DistanceToEdgeIsToTheNearestOfTheFour) {
  EXPECT_EQ(kArea.distance_to_edge(at(-8, 150)), Meters{2});
  EXPECT_EQ(kArea.distance_to_edge(at(27, 150)), Meters{3});
  EXPECT_EQ(kArea.distance_to_edge(at(10, 104)), Meters{4});
  EXPECT_EQ(kArea.distance_to_edge(at(10, 195)), Meters{5});
}

TEST(Rectangle, DistanceToEdgeIsNegativeOutside) {
  EXPECT_EQ(kArea.distance_to_edge(at(37, 150)), Meters{-7});
}

TEST(Rectangle, MovesEveryEdgeInByTheMargin) {
  EXPECT_EQ(kArea.moved_in(Meters{4}), (Rectangle{.south_west = at(-6, 104), .north_east = at(26, 196)}));
}

TEST(Rectangle, DoesNotContainAPlaceThatIsNotANumber) {
  EXPECT_FALSE(kArea.contains(at(std::numeric_limits<double>::quiet_NaN(), 150)));
}

}  // namespace
}  // namespace earshot
