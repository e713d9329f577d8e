#include "firmware/boards/linux/clock/host_mission_clock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace earshot::board {
namespace {

constexpr Duration kPollInterval = Duration::milliseconds(100);  ///< how often a waiting loop looks whether it is to stop

/// Exact where nothing is scaled.
Duration scaled(Duration duration, double factor) {
  if (factor == 1.0) return duration;
  return {std::llround(static_cast<double>(duration.us) * factor)};
}

/// How long a pair of readings is good for: a flood of dates costs one reading each, and a wall clock that is set misdates this long.
constexpr Duration kMomentLasts = Duration::milliseconds(10);

}  // namespace

/// Both clocks as of one moment: a process halted between the two readings would call a date older than it is by the length of the halt,
/// so that they are read anew, four times at most, until little lies between them.
HostMissionClock::Moment HostMissionClock::moment_of(const HostClock& host) {
  constexpr Duration kClose = Duration{20};
  constexpr int kMost = 4;
  Moment closest;
  Duration apart;
  for (int i = 0; i < kMost && (i == 0 || apart > kClose); ++i) {
    const Duration before = host.monotonic();
    const Time utc = host.utc();
    const Duration passed = host.monotonic() - before;
    if (i > 0 && passed >= apart) continue;
    closest = {.utc = utc, .monotonic = before};
    apart = passed;
  }
  return closest;
}

HostMissionClock::HostMissionClock(const HostClock& host, double speed, std::optional<Time> since)
    : host_(host), speed_(speed), began_(host.utc()), began_on_host_(host.monotonic()), moment_(moment_of(host)) {
  if (since) began_ = *since + scaled(began_ - *since, speed_);
}

void HostMissionClock::go_on_since(Time mission_time, Duration passed_on_host) {
  go_on_at(mission_time + scaled(passed_on_host, speed_));
}

void HostMissionClock::be_at_least(Time mission_time) {
  if (now() < mission_time) go_on_at(mission_time);
}

Time HostMissionClock::now() {
  return began_ + scaled(host_.monotonic() - began_on_host_, speed_);
}

Time HostMissionClock::mission_time_of(Time utc) {
  constexpr Time kNoDate{-1};
  constexpr Time kLatest{std::int64_t{1} << 55};  // the year 3111, which is never; a hundred times it fits
  if (utc.us < 0) return kNoDate;
  const Moment& now = moment();
  return mission_time_at(now) + scaled(std::min(utc, kLatest) - now.utc, speed_);
}

Time HostMissionClock::utc_of(Time mission_time) {
  const Moment& now = moment();
  return now.utc + scaled(mission_time - mission_time_at(now), 1.0 / speed_);
}

const HostMissionClock::Moment& HostMissionClock::moment() {
  if (host_.monotonic() - moment_.monotonic >= kMomentLasts) moment_ = moment_of(host_);
  return moment_;
}

Time HostMissionClock::mission_time_at(const Moment& moment) const {
  return began_ + scaled(moment.monotonic - began_on_host_, speed_);
}

Clock::Wake HostMissionClock::wait(const Awaited& awaited) {
  const Duration left = scaled(awaited.next_turn - now(), 1.0 / speed_);
  if (left > Duration{}) wait_for_ports(awaited.ports, std::min(left, kPollInterval));
  return now() >= awaited.next_turn ? Wake::kTurn : Wake::kPorts;
}

}  // namespace earshot::board
