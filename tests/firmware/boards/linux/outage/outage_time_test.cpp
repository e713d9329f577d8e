#include "firmware/boards/linux/outage/outage_time.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace earshot::board {
namespace {

constexpr BootId kThisBoot{1, 2, 3};
constexpr BootId kLastBoot{3, 2, 1};

class SomeHost final : public HostClock {
 public:
  [[nodiscard]] Time utc() const override { return utc_now; }
  [[nodiscard]] Duration since_boot() const override { return running; }
  [[nodiscard]] BootId boot() const override { return boot_id; }
  Time utc_now{1'795'000'000'000'000};
  Duration running = Duration::seconds(500);
  BootId boot_id = kThisBoot;
};

/// Written so long ago, by this host's clocks.
host::SafetyRecord written(const SomeHost& host, Duration ago) {
  host::SafetyRecord record;
  record.boot = host.boot_id;
  record.since_boot = host.running - ago;
  record.utc = Time{host.utc_now.us - ago.us};
  return record;
}

TEST(OutageTime, IsExactWhileTheComputerRunsOnWhateverBecameOfTheWallClock) {
  for (const Duration set : {Duration{}, Duration::seconds(-2), Duration::seconds(-20 * 3600), Duration::seconds(20 * 3600)}) {
    SomeHost host;
    const host::SafetyRecord record = written(host, Duration::seconds(1));
    host.utc_now = host.utc_now + set;
    EXPECT_EQ(outage_since(record, host).passed, Duration::seconds(1)) << set.to_seconds();
    EXPECT_EQ(outage_since(record, host).least, Duration{});
  }
}

TEST(OutageTime, OfAComputerThatStartedAgainIsTheWallClocksWithinItsBounds) {
  SomeHost host;
  host.running = Duration::seconds(40);
  host::SafetyRecord record = written(host, Duration::seconds(90));
  record.boot = kLastBoot;
  record.since_boot = Duration::seconds(7000);
  EXPECT_EQ(outage_since(record, host).passed, Duration::seconds(90));
  EXPECT_EQ(outage_since(record, host).least, Duration::seconds(40)) << "for so long it runs";
  const Time right = host.utc_now;
  for (const std::int64_t behind_s : {60, 91, 20 * 3600, 50 * 365 * 86'400}) {
    host.utc_now = right + Duration::seconds(-behind_s);
    EXPECT_EQ(outage_since(record, host).passed, Duration::seconds(40)) << "no real-time clock, " << behind_s << " s behind";
  }
  host.utc_now = right + Duration::seconds(20 * 3600);
  EXPECT_EQ(outage_since(record, host).passed, kMostByWallClock);
  host.running = Duration::seconds(2 * 3600);
  EXPECT_EQ(outage_since(record, host).passed, host.running) << "it ran for longer than that";
}

TEST(OutageTime, WhereTheBootIsNotKnownTheRunningClockIsTheLeast) {
  SomeHost host;
  host.boot_id = {};
  host::SafetyRecord record = written(host, Duration::seconds(30));
  EXPECT_EQ(outage_since(record, host).passed, Duration::seconds(30));
  host.utc_now = host.utc_now + Duration::seconds(-3600);
  EXPECT_EQ(outage_since(record, host).passed, Duration::seconds(30));
  record.since_boot = host.running + Duration::seconds(1);  // it has begun again
  EXPECT_EQ(outage_since(record, host).passed, host.running);
}

}  // namespace
}  // namespace earshot::board
