#include "sim/hydrophone/hydrophone_bus.hpp"

#include "earshot/hydrophone_block_t.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::hydrophone {
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

}  // namespace

HydrophoneBus::HydrophoneBus(const std::string& lcm_url) : endpoint_(host::parse_lcm_url(lcm_url), {}) {}

Status HydrophoneBus::publish(const messages::HydrophoneBlock& block, std::span<const float> samples) {
  const hydrophone_block_t message = message_of(block, samples);
  bytes_.resize(static_cast<std::size_t>(message.getEncodedSize()));
  (void)message.encode(bytes_.data(), 0, static_cast<int>(bytes_.size()));
  const Status status = endpoint_.publish(wire::kHydrophoneBlockChannel, bytes_);
  if (status == Status::kOk) ++blocks_;
  return status;
}

}  // namespace earshot::hydrophone
