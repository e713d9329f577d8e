#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/text/utc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace earshot::journal {
namespace {

// Dates: GNU date.
TEST(JournalWording, SaysADateOfAClockThatHasOne) {
  EXPECT_EQ(utc(Time{1'795'359'847'999'999}), "2026-11-22 15:04:07 UTC");
  EXPECT_EQ(utc(Time{951'782'400'000'000}), "2000-02-29 00:00:00 UTC");
}

TEST(JournalWording, TakesASimulatorsClockAndAnImpossibleOneForUndated) {
  EXPECT_FALSE(host::is_dated(Time{}));
  EXPECT_FALSE(host::is_dated(Time{-1}));
  EXPECT_FALSE(host::is_dated(Time{946'684'799'999'999}));
  EXPECT_TRUE(host::is_dated(Time{946'684'800'000'000}));  // 2000-01-01
  EXPECT_FALSE(host::is_dated(Time{std::numeric_limits<std::int64_t>::max()}));
}

TEST(JournalWording, WritesNumbersOfAnySizeWithTheirPlaces) {
  EXPECT_EQ(host::decimals(12.345, 2), "12.35");
  EXPECT_EQ(host::decimals(-0.5, 0), "-0");
  EXPECT_EQ(host::decimals(std::numeric_limits<double>::max(), 6).size(), 316U);
  EXPECT_EQ(host::decimals(std::numeric_limits<double>::quiet_NaN(), 1), "nan");
}

TEST(JournalWording, CountsOneAndMany) {
  EXPECT_EQ(host::counted(0, "record"), "0 records");
  EXPECT_EQ(host::counted(1, "record"), "1 record");
}

TEST(JournalWording, WritesAHeadingJustBelowNorthAsNorth) {
  EXPECT_EQ(compass(Radians{-1e-6}, 3), "0.000");    // 359.99994 degrees
  EXPECT_EQ(compass(Radians{-1e-5}, 3), "359.999");  // 359.99943
  EXPECT_EQ(compass(Radians{-0.01}, 0), "359");
  EXPECT_EQ(compass(Radians{-0.005}, 0), "0");
  EXPECT_EQ(compass(Radians{std::nan("")}, 3), "");
}

TEST(JournalWording, KeepsTheMicrosecondsOfADate) {
  EXPECT_EQ(host::decimals(seconds_of(Time{1'795'359'847'080'925}), 6), "1795359847.080925");
}

}  // namespace
}  // namespace earshot::journal
