#include "hil/nodes/pace.hpp"

#include <gtest/gtest.h>

namespace earshot::hil {
namespace {

Time at(std::int64_t ms) {
  return Time{} + Duration::milliseconds(ms);
}

TEST(Pace, IsDueAtOnceAndThenOnceAPeriodHoweverOftenItIsAsked) {
  Pace pace(Duration::milliseconds(100));
  EXPECT_TRUE(pace.is_due(at(5)));
  EXPECT_FALSE(pace.is_due(at(5)));
  EXPECT_FALSE(pace.is_due(at(104)));
  EXPECT_TRUE(pace.is_due(at(105)));
}

TEST(Pace, LosesNoTimeToWhoeverAsksALittleLate) {
  Pace pace(Duration::milliseconds(100));
  int due = 0;
  for (int ms = 0; ms < 1000; ms += 30) due += pace.is_due(at(ms)) ? 1 : 0;
  EXPECT_EQ(due, 10) << "0, 120, 210, 300, 420, 510, 600, 720, 810, 900";
}

TEST(Pace, DoesNotMakeUpForWhatWasMissed) {
  Pace pace(Duration::milliseconds(100));
  EXPECT_TRUE(pace.is_due(at(0)));
  EXPECT_TRUE(pace.is_due(at(1050)));
  EXPECT_FALSE(pace.is_due(at(1149)));
  EXPECT_TRUE(pace.is_due(at(1150)));
  EXPECT_TRUE(pace.is_due(at(1350))) << "a period late";
  EXPECT_FALSE(pace.is_due(at(1351)));
}

}  // namespace
}  // namespace earshot::hil
