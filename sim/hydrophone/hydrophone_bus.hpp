#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/status.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/messages/hydrophone_block.hpp"

namespace earshot::hydrophone {

/// The other side of the vehicle's hydrophone port: puts sound on its bus, as the driver of an ADC does at sea.
class HydrophoneBus {
 public:
  /// @throws std::system_error naming what cannot be opened.
  explicit HydrophoneBus(const std::string& lcm_url);

  /// @return not kOk when the bus cannot carry it
  [[nodiscard]] Status publish(const messages::HydrophoneBlock& block, std::span<const float> samples);
  [[nodiscard]] std::uint64_t blocks() const { return blocks_; }  ///< published

 private:
  host::LcmEndpoint endpoint_;
  std::vector<std::uint8_t> bytes_;
  std::uint64_t blocks_ = 0;
};

}  // namespace earshot::hydrophone
