#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "firmware/host/transport/lcm_endpoint.hpp"
#include "hil/nodes/sound/hydrophone_samples.hpp"

namespace earshot::hil {

/// A hydrophone that puts its samples on LCM, in a thread of its own, from when it is made until it goes.
/// Oracle: SampleSender tests
class SampleSender {
 public:
  /// @param url    of LCM
  /// @param speed  seconds of its ADC in one of the host's, > 0
  /// @throws std::system_error, std::invalid_argument as host::LcmEndpoint does
  SampleSender(const std::string& url, double speed, Decibels snr, std::uint64_t seed);

  /// From the next block on.
  void disturb(const SoundFault& fault);
  [[nodiscard]] std::uint64_t sent() const { return sent_; }  ///< blocks

 private:
  void send(const std::stop_token& stop, double speed);
  void publish();

  HydrophoneSamples samples_;
  host::LcmEndpoint endpoint_;
  std::vector<std::uint8_t> bytes_;
  std::mutex guard_;  ///< of the fault
  SoundFault fault_;
  std::atomic<std::uint64_t> sent_ = 0;
  std::jthread thread_;  ///< after what it uses
};

}  // namespace earshot::hil
