#include "hil/nodes/sound/sample_sender.hpp"

#include <cmath>
#include <ctime>

#include "earshot/hydrophone_block_t.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "hil/nodes/scaled_clock.hpp"

namespace earshot::hil {
namespace {

hydrophone_block_t message_of(const messages::HydrophoneBlock& block, std::span<const float> samples) {
  hydrophone_block_t message;
  message.utime = block.time.us;
  message.sequence = block.sequence;
  message.first_sample = block.first_sample;
  message.sample_rate_hz = block.sample_rate.value;
  message.gain_db = block.gain.value;
  message.overflow_count = static_cast<std::int32_t>(block.overflow_count);
  message.channels = static_cast<std::int8_t>(block.channels);
  message.sample_count = static_cast<std::int32_t>(samples.size());
  message.samples.assign(samples.begin(), samples.end());
  return message;
}

void sleep_until(Time host) {
  const timespec wake{.tv_sec = host.us / 1'000'000, .tv_nsec = host.us % 1'000'000 * 1000};
  (void)::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr);
}

}  // namespace

SampleSender::SampleSender(const std::string& url, double speed, Decibels snr, std::uint64_t seed)
    : samples_(snr, seed),
      endpoint_(host::parse_lcm_url(url), {}),
      thread_([this, speed](const std::stop_token& stop) { send(stop, speed); }) {}

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
    if (samples_.take(ScaledClock::utc())) publish();
  }
}

void SampleSender::publish() {
  const hydrophone_block_t message = message_of(samples_.block(), samples_.samples());
  bytes_.resize(static_cast<std::size_t>(message.getEncodedSize()));
  (void)message.encode(bytes_.data(), 0, static_cast<int>(bytes_.size()));
  if (endpoint_.publish(wire::kHydrophoneBlockChannel, bytes_) == Status::kOk) ++sent_;
}

}  // namespace earshot::hil
