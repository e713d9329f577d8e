#include "firmware/core/time.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace earshot {
namespace {

TEST(Duration, CountsMicroseconds) {
  EXPECT_EQ(Duration::seconds(3).us, 3'000'000);
  EXPECT_EQ(Duration::milliseconds(-4).us, -4'000);
  EXPECT_EQ(Duration{2'500'000}.to_seconds(), 2.5);
  EXPECT_EQ(Duration::seconds(3) + Duration::milliseconds(4), Duration{3'004'000});
  EXPECT_EQ(Duration::seconds(3) - Duration::milliseconds(4), Duration{2'996'000});
  EXPECT_LT(Duration::milliseconds(999), Duration::seconds(1));
}

TEST(Time, IsAsFarFromAnotherAsTheDurationBetweenThem) {
  EXPECT_EQ(Time{1'000'000} - Time{400'000}, Duration{600'000});
  EXPECT_EQ(Time{1'000'000} + Duration::seconds(2), Time{3'000'000});
  EXPECT_GT(Time{2}, Time{1});
}

TEST(LiesWithin, TakesDatesFromAsFarAheadAsBehindAndNoneFurther) {
  constexpr Time kNow{100};
  constexpr Duration kMost{30};
  for (const std::int64_t date : {70, 71, 100, 129, 130}) EXPECT_TRUE(lies_within(Time{date}, kNow, kMost)) << date;
  for (const std::int64_t date : {0, 69, 131, 1'000}) EXPECT_FALSE(lies_within(Time{date}, kNow, kMost)) << date;
}

TEST(LiesWithin, TakesNoDateBeforeTheEpochWhateverASenderSays) {
  EXPECT_TRUE(lies_within(Time{0}, Time{10}, Duration{30}));
  EXPECT_FALSE(lies_within(Time{-1}, Time{10}, Duration{30}));
  EXPECT_FALSE(lies_within(Time{std::numeric_limits<std::int64_t>::min()}, Time{10}, Duration{30}));
  EXPECT_FALSE(lies_within(Time{std::numeric_limits<std::int64_t>::max()}, Time{10}, Duration{30}));
}

}  // namespace
}  // namespace earshot
