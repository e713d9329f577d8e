#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "firmware/core/random.hpp"
#include "firmware/safety/navigation_judge.hpp"

namespace earshot::safety {
namespace {

messages::Navigation fix_at_ms(std::int64_t ms, double north_m, double east_m = 0.0) {
  return {.time = Time{} + Duration::milliseconds(ms),
          .position = {.north = Meters{north_m}, .east = Meters{east_m}},
          .depth = Meters{300},
          .heading = Radians{0},
          .speed = MetersPerSecond{2}};
}

config::VehicleLimits fast() {
  config::VehicleLimits limits;
  limits.max_speed = MetersPerSecond{3};
  limits.max_current = MetersPerSecond{2};
  return limits;
}

/// When it arrives, the vehicle is told to move.
bool takes(NavigationJudge& judge, const messages::Navigation& fix) {
  return judge.take(fix.time, fix, true);
}

// Into a current that is almost as fast as the vehicle; a bus rounds to 1.1 cm.
TEST(Standstill, IsNoSlowWay) {
  for (const double speed_mps : {0.03, 0.012}) {
    for (const int period_ms : {100, 1000}) {
      for (const double rounds_to_m : {1e-6, 0.011}) {
        NavigationJudge judge(fast(), Duration::seconds(5));
        for (int ms = 1000; ms <= 120'000; ms += period_ms) {
          const double north_m = rounds_to_m * std::round(speed_mps * 1e-3 * ms / rounds_to_m);
          EXPECT_TRUE(takes(judge, fix_at_ms(ms, north_m)));
          ASSERT_LE(judge.frozen(), Duration::seconds(5)) << speed_mps << " m/s, a fix every " << period_ms << " ms, at " << ms << " ms";
        }
      }
    }
  }
}

TEST(Standstill, IsNoticedThoughItShiversOrALastDigitChanges) {
  for (const double size_m : {0.01, 0.05, 0.08}) {
    for (const int period_ms : {200, 1000}) {
      for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        NavigationJudge judge(fast(), Duration::seconds(5));
        Pcg32 random(seed);
        int noticed_ms = 0;
        for (int ms = 1000; ms <= 20'000 && noticed_ms == 0; ms += period_ms) {
          EXPECT_TRUE(
              takes(judge, fix_at_ms(ms, size_m * (2.0 * random.uniform_double() - 1.0), size_m * (2.0 * random.uniform_double() - 1.0))));
          if (judge.frozen() > Duration::seconds(5)) noticed_ms = ms;
        }
        EXPECT_GT(noticed_ms, 0);
        EXPECT_LE(noticed_ms, 11'000) << size_m << " m, a fix every " << period_ms << " ms, seed " << seed;
      }
    }
  }
  NavigationJudge judge(fast(), Duration::seconds(5));
  for (int ms = 1000; ms <= 10'000; ms += 1000) EXPECT_TRUE(takes(judge, fix_at_ms(ms, ms / 3000 % 2 == 0 ? 0.0 : 0.011)));
  EXPECT_EQ(judge.frozen(), Duration::seconds(9)) << "a last digit that changes now and then";
}

}  // namespace
}  // namespace earshot::safety
