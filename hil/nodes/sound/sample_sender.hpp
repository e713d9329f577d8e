#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "hil/nodes/sound/hydrophone_samples.hpp"
#include "sim/hydrophone/hydrophone_bus.hpp"

namespace earshot::hil {

/// A hydrophone that puts its samples on LCM, in a thread of its own, from when it is made until it goes.
/// Oracle: SampleSender tests
class SampleSender {
 public:
  /// @param url    of LCM
  /// @param speed  seconds of its ADC in one of the host's, > 0
  /// @throws std::system_error, std::invalid_argument as hydrophone::HydrophoneBus does
  SampleSender(const std::string& url, double speed, Decibels snr, std::uint64_t seed);

  /// From the next block on.
  void disturb(const SoundFault& fault);

 private:
  void send(const std::stop_token& stop, double speed);

  HydrophoneSamples samples_;
  hydrophone::HydrophoneBus bus_;
  std::mutex guard_;  ///< of the fault
  SoundFault fault_;
  std::jthread thread_;  ///< after what it uses
};

}  // namespace earshot::hil
