#include "firmware/boards/linux/clock/host_clock.hpp"

#include <gtest/gtest.h>

#include <ctime>

namespace earshot::board {
namespace {

TEST(HostClock, CountsFrom1970InMicroseconds) {
  const std::time_t before = std::time(nullptr);
  const Time utc = HostClock().utc();
  const std::time_t after = std::time(nullptr);
  // time() may read a coarser clock, which lies up to a tick of some milliseconds behind.
  EXPECT_GE(utc.us, before * std::int64_t{1'000'000});
  EXPECT_LT(utc.us, (after + 2) * std::int64_t{1'000'000});
}

TEST(HostClock, NeverRunsBack) {
  const HostClock clock;
  Duration last = clock.monotonic();
  for (int i = 0; i < 1000; ++i) {
    const Duration now = clock.monotonic();
    ASSERT_GE(now, last);
    last = now;
  }
}

}  // namespace
}  // namespace earshot::board
