#include "firmware/core/units.hpp"

#include <gtest/gtest.h>

namespace earshot {
namespace {

TEST(Quantity, AddsScalesAndComparesAsItsNumberDoes) {
  const Meters seven{7.0};
  const Meters two{2.0};
  EXPECT_EQ(seven + two, Meters{9.0});
  EXPECT_EQ(seven - two, Meters{5.0});
  EXPECT_EQ(-seven, Meters{-7.0});
  EXPECT_EQ(3.0 * seven, Meters{21.0});
  EXPECT_EQ(seven * 3.0, Meters{21.0});
  EXPECT_EQ(seven / 2.0, Meters{3.5});
  EXPECT_EQ(seven / two, 3.5);
  EXPECT_LT(two, seven);
  EXPECT_EQ(Meters{}, Meters{0.0});
}

TEST(Quantity, GrowsAndShrinksInPlace) {
  Decibels level{5.0};
  level += Decibels{3.0};
  EXPECT_EQ(level, Decibels{8.0});
  level -= Decibels{10.0};
  EXPECT_EQ(level, Decibels{-2.0});
}

}  // namespace
}  // namespace earshot
