#include "policy/report/document/json_values.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace earshot::report {
namespace {

TEST(Rounded, HasAsManyDecimalsAsAreKnownAndAWholeNumberNone) {
  EXPECT_EQ(rounded(12.346, 2).dump(), "12.35");
  EXPECT_EQ(rounded(-0.04, 1).dump(), "0");
  EXPECT_EQ(rounded(299.98, 1).dump(), "300");
  EXPECT_EQ(rounded(1e17, 1).dump(), "1e+17") << "beyond what 64 bits hold it stays a double";
}

TEST(Rounded, IsNullOfWhatIsNoNumber) {
  EXPECT_EQ(rounded(std::numeric_limits<double>::quiet_NaN(), 1).dump(), "null");
  EXPECT_EQ(rounded(std::numeric_limits<double>::infinity(), 1).dump(), "null");
}

TEST(CompassValue, IsClockwiseFromNorthAndNeverAFullTurn) {
  EXPECT_EQ(compass_value(Radians{1.5707963267948966}).dump(), "90");
  EXPECT_EQ(compass_value(Radians{-0.7853981633974483}).dump(), "315");
  EXPECT_EQ(rounded_compass(359.94).dump(), "359.9");
  EXPECT_EQ(rounded_compass(359.96).dump(), "0");
}

TEST(PlaceValue, IsToTheDecimetre) {
  EXPECT_EQ(place_value({Meters{12.345}, Meters{-3.0}}).dump(), R"({"north_m":12.3,"east_m":-3})");
}

}  // namespace
}  // namespace earshot::report
