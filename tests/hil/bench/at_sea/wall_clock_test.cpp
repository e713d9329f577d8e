#include "hil/bench/at_sea/wall_clock.hpp"

#include <gtest/gtest.h>

#include "hil/nodes/scaled_clock.hpp"

namespace earshot::hil {
namespace {

/// By how much the wall clock is ahead of the clock that nobody sets.
double ahead_s() {
  return ((ScaledClock::utc() - Time{}) - (ScaledClock::host_now() - Time{})).to_seconds();
}

constexpr double kBetweenTwoReadings_s = 60.0;  // of two clocks, on a machine that others use; the clock is set by many times that

TEST(WallClockAhead, IsAheadOrBehindAsLongAsItLives) {
  if (!has_clock_of_its_own()) GTEST_SKIP() << "this computer's clock is others' too";
  const double before = ahead_s();
  for (const double seconds : {72'000.0, -7'200.0}) {
    {
      const WallClockAhead ahead(seconds);
      EXPECT_NEAR(ahead_s() - before, seconds, kBetweenTwoReadings_s);
    }
    EXPECT_NEAR(ahead_s(), before, kBetweenTwoReadings_s);
  }
}

}  // namespace
}  // namespace earshot::hil
