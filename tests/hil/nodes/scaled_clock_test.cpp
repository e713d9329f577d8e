#include "hil/nodes/scaled_clock.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace earshot::hil {
namespace {

using namespace std::chrono_literals;

std::int64_t host_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TEST(ScaledClock, RunsSoManyTimesAsFastAsTheHost) {
  const std::int64_t earliest = host_us();
  const ScaledClock clock(50.0);
  const std::int64_t made = host_us();
  const Time began = clock.now();
  const std::int64_t read_at_us = host_us();
  std::this_thread::sleep_for(50ms);
  const std::int64_t before = host_us();
  const Time now = clock.now();
  const std::int64_t after = host_us();
  // Whatever the machine does meanwhile, it lies between what had passed before each reading and after it; 50 us are one of the host's.
  EXPECT_GE((now - began).us, 50 * (before - read_at_us) - 100);
  EXPECT_LE((now - began).us, 50 * (after - earliest) + 100);
  EXPECT_GE(after, made);
}

TEST(ScaledClock, BeginsWithTheWallClocksTime) {
  const Time before = ScaledClock::utc();
  const ScaledClock clock(1.0);
  const Time now = clock.now();
  const Time after = ScaledClock::utc();
  EXPECT_GE(now, before);
  EXPECT_LE(now, after + Duration::milliseconds(1));  // the two clocks of the host tick apart
}

TEST(ScaledClock, SaysHowLongItsTimeTakesOnTheHost) {
  EXPECT_EQ(ScaledClock(20.0).on_host(Duration::milliseconds(100)), Duration::milliseconds(5));
  EXPECT_EQ(ScaledClock(0.5).on_host(Duration::seconds(1)), Duration::seconds(2));
}

}  // namespace
}  // namespace earshot::hil
