#include "firmware/safety/standing_alarm.hpp"

#include <gtest/gtest.h>

namespace earshot::safety {
namespace {

constexpr std::uint8_t kOne = 1;
constexpr std::uint8_t kTwo = 2;

class StandingAlarmTest : public testing::Test {
 protected:
  bool stands_after(int s, std::uint8_t port, bool is_reported) {
    alarm_.take(Time{} + Duration::seconds(s), port, is_reported);
    return alarm_.stands();
  }

  StandingAlarm alarm_;
};

TEST_F(StandingAlarmTest, IsTakenBackByThePortThatToldItAndByNoOther) {
  EXPECT_FALSE(stands_after(1, kTwo, false));
  EXPECT_TRUE(stands_after(2, kOne, true));
  for (int s = 3; s < 100; ++s) EXPECT_TRUE(stands_after(s, kTwo, false)) << "its sender may have drowned";
  EXPECT_FALSE(stands_after(100, kOne, false)) << "a drop on a sensor";
  EXPECT_FALSE(stands_after(101, kOne, false));
}

TEST_F(StandingAlarmTest, StandsForGoodWhereASecondSenderOfThePortContradicts) {
  EXPECT_TRUE(stands_after(1, kOne, true));
  EXPECT_FALSE(stands_after(2, kOne, false));
  EXPECT_TRUE(stands_after(3, kOne, true));
  for (int s = 4; s < 100; ++s) EXPECT_TRUE(stands_after(s, kOne, false)) << s;
}

TEST_F(StandingAlarmTest, OfADropNowAndThenDoesNotStand) {
  for (int s = 0; s < 1000; s += 32) {
    EXPECT_TRUE(stands_after(s, kOne, true));
    EXPECT_FALSE(stands_after(s + 1, kOne, false)) << s;
  }
}

}  // namespace
}  // namespace earshot::safety
