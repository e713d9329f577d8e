#include "firmware/boards/linux/host_mission_clock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace earshot::board {
namespace {

constexpr Duration kLookUp = Duration::milliseconds(100);  ///< how often a waiting loop looks whether it is to stop

/// Exact where nothing is scaled.
Duration scaled(Duration duration, double factor) {
  if (factor == 1.0) return duration;
  return {std::llround(static_cast<double>(duration.us) * factor)};
}

}  // namespace

HostMissionClock::HostMissionClock(const HostClock& host, double speed)
    : host_(host), speed_(speed), began_(host.utc()), began_on_host_(host.monotonic()) {}

Time HostMissionClock::now() {
  return began_ + scaled(host_.monotonic() - began_on_host_, speed_);
}

Time HostMissionClock::mission_time_of(Time utc) {
  constexpr Time kNoDate{-1};
  constexpr Time kLatest{std::int64_t{1} << 55};  // the year 3111, which is never; a hundred times it fits
  if (utc.us < 0) return kNoDate;
  return now() + scaled(std::min(utc, kLatest) - host_.utc(), speed_);
}

Clock::Wake HostMissionClock::wait(const Awaited& awaited) {
  const Duration left = scaled(awaited.next_turn - now(), 1.0 / speed_);
  if (left > Duration{}) wait_for_ports(awaited.ports, std::min(left, kLookUp));
  return now() >= awaited.next_turn ? Wake::kTurn : Wake::kPorts;
}

}  // namespace earshot::board
