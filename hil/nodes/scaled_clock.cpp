#include "hil/nodes/scaled_clock.hpp"

#include <cmath>
#include <ctime>

namespace earshot::hil {
namespace {

Duration reading_of(clockid_t clock) {
  timespec time{};
  (void)clock_gettime(clock, &time);
  return {std::int64_t{time.tv_sec} * 1'000'000 + time.tv_nsec / 1000};
}

}  // namespace

ScaledClock::ScaledClock(double speed) : speed_(speed), began_(utc()), began_on_host_(host_now()) {}

Time ScaledClock::now() const {
  const Duration passed = host_now() - began_on_host_;
  return began_ + Duration{std::llround(static_cast<double>(passed.us) * speed_)};
}

Time ScaledClock::utc() {
  return Time{} + reading_of(CLOCK_REALTIME);
}

Time ScaledClock::host_now() {
  return Time{} + reading_of(CLOCK_MONOTONIC);
}

Duration ScaledClock::on_host(Duration duration) const {
  return {std::llround(static_cast<double>(duration.us) / speed_)};
}

}  // namespace earshot::hil
