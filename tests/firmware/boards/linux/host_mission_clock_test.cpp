#include "firmware/boards/linux/host_mission_clock.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace earshot::board {
namespace {

/// The clocks of a host, set by hand.
class SetHost final : public HostClock {
 public:
  [[nodiscard]] Time utc() const override { return wall; }
  [[nodiscard]] Duration monotonic() const override { return since_start; }
  void pass(Duration time) {
    wall = wall + time;
    since_start = since_start + time;
  }

  Time wall{1'000'000'000};
  Duration since_start = Duration::seconds(7);
};

constexpr Duration seconds(std::int64_t s) {
  return Duration::seconds(s);
}

TEST(HostMissionClock, BeginsWithUtcAndRunsOnThoughTheWallClockIsSet) {
  SetHost host;
  HostMissionClock clock(host);
  EXPECT_EQ(clock.now(), Time{1'000'000'000});
  host.pass(seconds(5));
  host.wall = host.wall + seconds(-3600);
  EXPECT_EQ(clock.now(), Time{1'005'000'000});
  host.pass(seconds(1));
  EXPECT_EQ(clock.now(), Time{1'006'000'000});
}

TEST(HostMissionClock, MovesADateByItsAgeThoughTheWallClockWasSet) {
  SetHost host;
  HostMissionClock clock(host);
  host.pass(seconds(5));
  host.wall = host.wall + seconds(3600);  // so do its senders' clocks
  EXPECT_EQ(clock.mission_time_of(host.wall + seconds(-2)), Time{1'003'000'000}) << "two seconds old";
  EXPECT_EQ(clock.arrival_of(host.wall), clock.now());
}

TEST(HostMissionClock, ScalesWhatPassesAndWhatIsOld) {
  SetHost host;
  HostMissionClock clock(host, 60.0);
  host.pass(seconds(5));
  EXPECT_EQ(clock.now(), Time{1'300'000'000}) << "5 s are 5 min";
  EXPECT_EQ(clock.mission_time_of(host.wall + seconds(-2)), Time{1'180'000'000}) << "2 s old are 2 min";
}

TEST(HostMissionClock, TakesADateThatCannotBeForNoneOrForTheFuture) {
  SetHost host;
  HostMissionClock clock(host, 100.0);
  EXPECT_LT(clock.mission_time_of(Time{-1}), Time{0});
  EXPECT_GT(clock.mission_time_of(Time{std::numeric_limits<std::int64_t>::max()}), clock.now());
}

TEST(HostMissionClock, WakesForATurnOnceItIsDue) {
  SetHost host;
  HostMissionClock clock(host);
  const Time next_turn = clock.now() + Duration::milliseconds(1);
  EXPECT_EQ(clock.wait({.ports = {}, .next_turn = next_turn}), Clock::Wake::kPorts) << "a host's clock that stands still";
  host.pass(Duration::milliseconds(1));
  EXPECT_EQ(clock.wait({.ports = {}, .next_turn = next_turn}), Clock::Wake::kTurn);
}

}  // namespace
}  // namespace earshot::board
