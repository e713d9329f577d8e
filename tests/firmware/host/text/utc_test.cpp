#include "firmware/host/text/utc.hpp"

#include <gtest/gtest.h>

namespace earshot::host {
namespace {

// date -u -d '2026-11-22 15:04:07' +%s
constexpr Time kInNovember{1'795'359'847'250'999};

TEST(HostUtc, IsTheCalendarsDateWithWhatIsLeftOfAMillisecondCutOff) {
  const CivilTime t = civil_time(kInNovember);
  EXPECT_EQ(t.year, 2026);
  EXPECT_EQ(t.month, 11U);
  EXPECT_EQ(t.day, 22U);
  EXPECT_EQ(t.hour, 15U);
  EXPECT_EQ(t.minute, 4U);
  EXPECT_EQ(t.second, 7U);
  EXPECT_EQ(t.millisecond, 250U);
  EXPECT_EQ(date_and_time(kInNovember), "2026-11-22 15:04:07");
  EXPECT_EQ(iso_8601(kInNovember), "2026-11-22T15:04:07.250Z");
}

TEST(HostUtc, BeforeTheEpochIsTheDayBefore) {
  const CivilTime t = civil_time(Time{-1});
  EXPECT_EQ(date_and_time(Time{-1}), "1969-12-31 23:59:59");
  EXPECT_EQ(t.millisecond, 999U);
}

// 2000-01-01 is 946684800, 10000-01-01 253402300800.
TEST(HostUtc, TellsAClockOfDatesFromASimulators) {
  EXPECT_FALSE(is_dated(Time{946'684'799'999'999}));
  EXPECT_TRUE(is_dated(Time{946'684'800'000'000}));
  EXPECT_TRUE(is_dated(Time{253'402'300'799'999'999}));
  EXPECT_FALSE(is_dated(Time{253'402'300'800'000'000}));
}

}  // namespace
}  // namespace earshot::host
