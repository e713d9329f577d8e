#include "firmware/host/text/numbers.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace earshot::host {
namespace {

TEST(HostNumbers, HaveAsManyDecimalsAsAreAskedForRoundedToTheNearest) {
  EXPECT_EQ(decimals(12.346, 2), "12.35");
  EXPECT_EQ(decimals(-0.5, 0), "-0") << "half goes to the even one";
  EXPECT_EQ(decimals(1e22, 1), "10000000000000000000000.0");
  EXPECT_EQ(decimals(std::numeric_limits<double>::infinity(), 3), "inf");
  EXPECT_EQ(decimals(std::numeric_limits<double>::quiet_NaN(), 3), "nan");
  EXPECT_EQ(decimals(-std::numeric_limits<double>::max(), 2).size(), 313U) << "309 digits, a sign, a point and two decimals";
}

TEST(HostNumbers, HaveNoMoreSignificantDigitsThanAreAskedForAndNoZerosBehindThem) {
  EXPECT_EQ(significant(35'400.0, 10), "35400");
  EXPECT_EQ(significant(0.25, 10), "0.25");
  EXPECT_EQ(significant(1.0 / 3.0, 4), "0.3333");
  EXPECT_EQ(significant(1e30, 10), "1e+30");
}

TEST(HostNumbers, InTheirShortestDigitsReadBackTheSame) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(0.1F), "0.1");
  EXPECT_EQ(shortest(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
}

TEST(HostNumbers, CountOneThingAndMore) {
  EXPECT_EQ(counted(0, "record"), "0 records");
  EXPECT_EQ(counted(1, "record"), "1 record");
  EXPECT_EQ(counted(12, "record"), "12 records");
  EXPECT_EQ(counted(1, "process", "processes"), "1 process");
  EXPECT_EQ(counted(2, "process", "processes"), "2 processes");
}

TEST(HostNumbers, AreFormattedAsPrintfDoesHoweverLongTheyAre) {
  EXPECT_EQ(formatted("%3d of %s", 7, "nine"), "  7 of nine");
  EXPECT_EQ(formatted("%s", ""), "");
  EXPECT_EQ(formatted("%6000d", 1).size(), 6'000U);
}

}  // namespace
}  // namespace earshot::host
