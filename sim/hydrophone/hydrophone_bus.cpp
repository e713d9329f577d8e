#include "sim/hydrophone/hydrophone_bus.hpp"

#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/hydrophone_block.hpp"

namespace earshot::hydrophone {
HydrophoneBus::HydrophoneBus(const std::string& lcm_url) : endpoint_(host::parse_lcm_url(lcm_url), {}) {}

Status HydrophoneBus::publish(const messages::HydrophoneBlock& block, std::span<const float> samples) {
  bytes_.resize(wire::hydrophone_block_bytes(samples.size()));
  wire::write_hydrophone_block(block, samples, bytes_);
  const Status status = endpoint_.publish(wire::kHydrophoneBlockChannel, bytes_);
  if (status == Status::kOk) ++blocks_;
  return status;
}

}  // namespace earshot::hydrophone
