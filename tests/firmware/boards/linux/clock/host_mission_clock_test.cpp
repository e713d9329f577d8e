#include "firmware/boards/linux/clock/host_mission_clock.hpp"

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

TEST(HostMissionClock, OfAMissionThatGoesOnIsWhereItIsToldAndDatesStillMoveByTheirAge) {
  SetHost host;
  HostMissionClock clock(host);
  clock.go_on_at(Time{500'000'000});
  EXPECT_EQ(clock.now(), Time{500'000'000});
  clock.be_at_least(Time{400'000'000});
  EXPECT_EQ(clock.now(), Time{500'000'000});
  clock.be_at_least(Time{600'000'000});
  host.pass(seconds(1));
  EXPECT_EQ(clock.now(), Time{601'000'000});
  EXPECT_EQ(clock.mission_time_of(host.wall + seconds(-2)), Time{599'000'000});
}

TEST(HostClock, KnowsThisStartOfTheComputer) {
  const HostClock host;
  EXPECT_NE(host.boot(), BootId{});
  EXPECT_EQ(host.boot(), HostClock().boot());
  const Duration before = host.since_boot();
  EXPECT_GT(before, Duration{});
  EXPECT_LE(before, host.since_boot());
}

TEST(HostMissionClock, ScalesWhatPassesAndWhatIsOld) {
  SetHost host;
  HostMissionClock clock(host, 60.0);
  host.pass(seconds(5));
  EXPECT_EQ(clock.now(), Time{1'300'000'000}) << "5 s are 5 min";
  EXPECT_EQ(clock.mission_time_of(host.wall + seconds(-2)), Time{1'180'000'000}) << "2 s old are 2 min";
}

// 20 s of the host's are 400 s of a rehearsal that runs twenty times as fast.
TEST(HostMissionClock, GoesOnSinceAMomentOfTheHostAtItsSpeed) {
  SetHost host;
  HostMissionClock clock(host, 20.0);
  clock.go_on_since(Time{500'000'000}, seconds(20));
  EXPECT_EQ(clock.now(), Time{900'000'000});
  host.pass(seconds(1));
  EXPECT_EQ(clock.now(), Time{920'000'000});
}

TEST(HostMissionClock, TellsTheWallsDateOfAMomentOfTheMission) {
  SetHost host;
  HostMissionClock fast(host, 60.0);
  HostMissionClock same(host);
  host.pass(seconds(5));
  EXPECT_EQ(fast.utc_of(fast.now()), host.wall);
  EXPECT_EQ(fast.utc_of(fast.now() + seconds(-120)), host.wall + seconds(-2)) << "2 min ago was 2 s ago";
  EXPECT_EQ(same.utc_of(same.now() + seconds(-2)), host.wall + seconds(-2));
  host.pass(seconds(1));
  host.wall = host.wall + seconds(3600);
  EXPECT_EQ(fast.utc_of(fast.now()), host.wall) << "as whoever reads it dates what he sends";
  const Time date = host.wall + seconds(-3);
  EXPECT_EQ(fast.utc_of(fast.mission_time_of(date)), date);
}

TEST(HostMissionClock, GoesOnWhereAnotherOfTheSameRehearsalIs) {
  SetHost host;
  const Time began = host.wall;
  HostMissionClock first(host, 20.0, began);
  EXPECT_EQ(first.now(), began) << "nothing has passed";
  host.pass(seconds(5));
  HostMissionClock second(host, 20.0, began);
  EXPECT_EQ(second.now(), Time{1'100'000'000}) << "5 s are 100 s";
  EXPECT_EQ(second.now(), first.now());
  host.pass(seconds(1));
  EXPECT_EQ(second.now(), Time{1'120'000'000});
  EXPECT_EQ(second.mission_time_of(host.wall + seconds(-2)), Time{1'080'000'000}) << "2 s old are 40 s";
}

/// A host whose process is halted for 40 ms between two readings of its clocks, the first times that they are read.
class HaltedHost final : public HostClock {
 public:
  [[nodiscard]] Time utc() const override {
    pass(halts > 0 ? Duration::milliseconds(40) : Duration{});
    if (halts > 0) --halts;
    return Time{1'000'000'000} + passed_;
  }
  [[nodiscard]] Duration monotonic() const override {
    pass(Duration{1});
    return passed_;
  }
  void pass(Duration time) const { passed_ = passed_ + time; }
  mutable int halts = 0;

 private:
  mutable Duration passed_;
};

TEST(HostMissionClock, DatesRightThoughItIsHaltedBetweenTwoClocks) {
  HaltedHost host;
  HostMissionClock clock(host, 50.0);
  const Time now = host.utc();
  host.pass(Duration::milliseconds(20));
  host.halts = 2;
  EXPECT_NEAR(static_cast<double>(clock.mission_time_of(now).us - clock.now().us), -50.0 * 100'000.0, 50.0 * 20.0)
      << "100 ms have passed since, which are 5 s, and no 40 ms more or less";
}

TEST(HostMissionClock, ReadsOneClockADateInAFlood) {
  HaltedHost host;  // every reading takes a microsecond
  HostMissionClock clock(host);
  const Time date = host.utc();
  const Duration before = host.monotonic();
  for (int i = 0; i < 1000; ++i) (void)clock.mission_time_of(date);
  EXPECT_LE((host.monotonic() - before).us, 1010);
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
