#include "firmware/boards/linux/sender_clock.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace earshot::board {
namespace {

constexpr Time kNow{1'795'000'000'000'000};
constexpr Duration kTimeout = Duration::seconds(8);  // believed within 4 s, a run lasts 2 s and is even to 1 s

Time after(std::int64_t seconds) {
  return kNow + Duration::seconds(seconds);
}

TEST(SenderClock, LeavesADateWithinHalfTheTimeoutAsItIs) {
  SenderClock clock(kTimeout);
  EXPECT_EQ(clock.to_mission_time(after(-4), kNow), after(-4));
  EXPECT_EQ(clock.to_mission_time(after(4), kNow), after(4));
}

TEST(SenderClock, FollowsAClockThatWasSetOnceItHasRunOnForAQuarterOfTheTimeout) {
  for (const std::int64_t set_by : {-3600, 3600}) {
    SenderClock clock(kTimeout);
    EXPECT_EQ(clock.to_mission_time(kNow, kNow), kNow);
    EXPECT_FALSE(clock.to_mission_time(after(1 + set_by), after(1)));
    EXPECT_FALSE(clock.to_mission_time(after(2 + set_by), after(2)));
    EXPECT_EQ(clock.to_mission_time(after(3 + set_by), after(3)), after(3));
    EXPECT_EQ(clock.to_mission_time(after(4 + set_by), after(5)), after(4)) << "a message may still be old";
  }
}

TEST(SenderClock, NeverBelievesADateThatStandsStill) {
  SenderClock clock(kTimeout);
  for (int second = 5; second < 60; ++second) EXPECT_FALSE(clock.to_mission_time(kNow, after(second))) << second;
}

TEST(SenderClock, NeverBelievesOldMessagesThatArriveAllAtOnce) {
  SenderClock clock(kTimeout);
  for (int second = 0; second < 60; ++second) EXPECT_FALSE(clock.to_mission_time(after(second), after(100))) << second;
}

TEST(SenderClock, DoesNotFollowABadSenderBesideAGoodOne) {
  SenderClock clock(kTimeout);
  for (int second = 0; second < 60; ++second) {
    EXPECT_EQ(clock.to_mission_time(after(second), after(second)), after(second));
    EXPECT_FALSE(clock.to_mission_time(after(second - 3600), after(second)));
  }
}

TEST(SenderClock, RefusesDatesThatNoClockShows) {
  SenderClock clock(kTimeout);
  EXPECT_FALSE(clock.to_mission_time({-1}, kNow));
  EXPECT_FALSE(clock.to_mission_time({std::numeric_limits<std::int64_t>::min()}, kNow));
  EXPECT_FALSE(clock.to_mission_time({std::numeric_limits<std::int64_t>::max()}, kNow));
}

}  // namespace
}  // namespace earshot::board
