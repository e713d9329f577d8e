#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "earshot/hydrophone_block_t.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"

namespace earshot::support {

/// A hydrophone's driver as a stranger writes one: blocks of lcm-gen's type, one after the other, on a bus.
class HydrophoneDriver {
 public:
  struct Sound {
    double sample_rate_hz = 96'000;
    std::int8_t channels = 8;
    std::int32_t samples_per_block = 1024;  ///< of each channel
  };
  HydrophoneDriver(const std::string& url, const Sound& sound);

  /// The next block; what is changed in it stays changed, but for counters and date.
  hydrophone_block_t& block() { return block_; }
  /// Puts the next block on the bus. @return whether the kernel took it
  bool send();
  /// The ADC goes on, and nothing is sent of it.
  void lose_samples(std::int64_t count) { block_.first_sample += count; }
  /// A block is made and lost on its way.
  void lose_block();
  /// Sends as the ADC would make blocks, for so long.
  void send_in_time_for(std::chrono::milliseconds duration);

  /// Samples of one channel that the ADC has taken so far.
  [[nodiscard]] std::uint64_t taken() const { return static_cast<std::uint64_t>(block_.first_sample); }

 private:
  void advance();

  hydrophone_block_t block_;
  host::LcmEndpoint endpoint_;
};

[[nodiscard]] std::vector<std::uint8_t> encoded(const hydrophone_block_t& block);

}  // namespace earshot::support
