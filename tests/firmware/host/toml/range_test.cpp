#include "firmware/host/toml/range.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace earshot::host {
namespace {

TEST(Range, AllowsItsBoundsButTheLowerOneOnlyWhereItIsNotAbove) {
  EXPECT_TRUE(Range::between(-1.0, 2.0).allows(-1.0));
  EXPECT_TRUE(Range::between(-1.0, 2.0).allows(2.0));
  EXPECT_FALSE(Range::above(-1.0).allows(-1.0));
  EXPECT_FALSE(Range::above_up_to(-1.0, 2.0).allows(2.5));
}

TEST(Range, AllowsNothingThatIsNotFinite) {
  EXPECT_FALSE(Range{}.allows(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(Range{}.allows(-std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(Range{}.allows(std::numeric_limits<double>::quiet_NaN()));
}

TEST(Range, IsToldWithTheBoundsThatItHas) {
  EXPECT_EQ(to_string(Range{}), "must be a finite number");
  EXPECT_EQ(to_string(Range::at_least(0.0)), "must be a finite number of at least 0");
  EXPECT_EQ(to_string(Range::above_up_to(0.0, 12'000.0)), "must be a finite number above 0 and at most 12000");
}

TEST(Range, WritesWholeBoundsInFullUpToTenDigits) {
  EXPECT_EQ(to_string(Range::between(-1e6, 1e6)), "must be a finite number of at least -1000000 and at most 1000000");
  EXPECT_EQ(to_string(Range::between(123'456'789.0, 9'999'999'999.0)),
            "must be a finite number of at least 123456789 and at most 9999999999");
  EXPECT_EQ(to_string(Range::at_least(1e10)), "must be a finite number of at least 1e+10");
  EXPECT_EQ(to_string(Range::between(0.0, 1e30)), "must be a finite number of at least 0 and at most 1e+30");
}

TEST(Range, LeavesBoundsThatAreNotWholeAsShortAsTheyAre) {
  EXPECT_EQ(to_string(Range::between(0.01, 2.5)), "must be a finite number of at least 0.01 and at most 2.5");
  EXPECT_EQ(to_string(Range::at_least(1e-300)), "must be a finite number of at least 1e-300");
}

}  // namespace
}  // namespace earshot::host
