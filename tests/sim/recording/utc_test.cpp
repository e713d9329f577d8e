#include "sim/recording/utc.hpp"

#include <gtest/gtest.h>

namespace earshot::recording {
namespace {

// Seconds since 1970 by GNU date.
TEST(Utc, AgreesWithGnuDate) {
  EXPECT_EQ(utc({2019, 9, 24, 17, 17, 30}), Time{1'569'345'450'000'000});
  EXPECT_EQ(utc({2020, 9, 12, 23, 15, 33}), Time{1'599'952'533'000'000});
  EXPECT_EQ(utc({2020, 2, 29, 12, 0, 0}), Time{1'582'977'600'000'000});
}

TEST(Utc, KnowsNoDayOrTimeThatIsInNoCalendar) {
  EXPECT_FALSE(utc({2021, 2, 29, 0, 0, 0}));
  EXPECT_FALSE(utc({2021, 0, 1, 0, 0, 0}));
  EXPECT_FALSE(utc({2021, 1, 1, 24, 0, 0}));
  EXPECT_FALSE(utc({2021, 1, 1, 0, 60, 0}));
}

TEST(Utc, IsWrittenWithMilliseconds) {
  EXPECT_EQ(to_iso(Time{1'582'977'600'000'000 + 1'250'400}), "2020-02-29T12:00:01.250Z");
}

}  // namespace
}  // namespace earshot::recording
