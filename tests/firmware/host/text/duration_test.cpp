#include "firmware/host/text/duration.hpp"

#include <gtest/gtest.h>

namespace earshot::host {
namespace {

TEST(HostDuration, IsInSecondsBelowTwoMinutesInMinutesBelowAnHourAndElseInHoursAndMinutes) {
  EXPECT_EQ(duration(0.4), "0 s");
  EXPECT_EQ(duration(119.4), "119 s");
  EXPECT_EQ(duration(120.0), "2 min");
  EXPECT_EQ(duration(59 * 60 + 29), "59 min");
  EXPECT_EQ(duration(59 * 60 + 30), "1 h 00 min");
  EXPECT_EQ(duration(50'000.0), "13 h 53 min") << "13.89 hours";
  EXPECT_EQ(duration(65 * 60), "1 h 05 min");
}

}  // namespace
}  // namespace earshot::host
