#include "hil/nodes/sound/sample_sender.hpp"

#include <cmath>
#include <ctime>

#include "firmware/host/transport/timespec.hpp"
#include "hil/nodes/scaled_clock.hpp"

namespace earshot::hil {
namespace {

void sleep_until(Time host) {
  const timespec wake = host::timespec_of(host - Time{});
  (void)::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr);
}

}  // namespace

SampleSender::SampleSender(const std::string& url, double speed, Decibels snr, std::uint64_t seed)
    : samples_(snr, seed), bus_(url), thread_([this, speed](const std::stop_token& stop) { send(stop, speed); }) {}

void SampleSender::disturb(const SoundFault& fault) {
  const std::lock_guard lock(guard_);
  fault_ = fault;
}

/// Blocks end by the wall clock, whatever the speed is: that is how earshotd reads dates. One that is late does not move the next: an ADC
/// leaves none out.
void SampleSender::send(const std::stop_token& stop, double speed) {
  const Time began = ScaledClock::host_now();
  for (std::int64_t block = 1; !stop.stop_requested(); ++block) {
    sleep_until(began + Duration{std::llround(static_cast<double>(block * HydrophoneSamples::kBlock.us) / speed)});
    {
      const std::lock_guard lock(guard_);
      samples_.disturb(fault_);
    }
    // What the bus does not carry is lost, as at sea: the next block says how many samples came before it.
    if (samples_.take(ScaledClock::utc())) static_cast<void>(bus_.publish(samples_.block(), samples_.samples()));
  }
}

}  // namespace earshot::hil
