#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/node/node.hpp"
#include "hil/nodes/device.hpp"

namespace earshot::hil {

/// Who an emulated device is. Class and function after NMEA 2000, appendix B.6; all devices are of Earshot's maker code.
struct Nameplate {
  std::string_view model;  ///< outlives the device
  std::uint8_t device_class = 0;
  std::uint8_t device_function = 0;
  std::uint8_t preferred_address = 0;
  std::uint32_t unique_number = 0;  ///< 21 bits; no two devices on a bus have the same
};

/// A device's place in the network, which is the same for all: an address claimed and kept, questions answered, a heartbeat.
class Membership {
 public:
  /// @param sends,reads  the groups of the device itself; those of every device come to them
  /// Throws std::invalid_argument for a unique number over 21 bits.
  Membership(const Nameplate& plate, std::vector<std::uint32_t> sends, std::vector<std::uint32_t> reads);
  Membership(const Membership&) = delete;
  Membership& operator=(const Membership&) = delete;

  [[nodiscard]] std::string_view model() const { return model_; }
  void accept(const n2k::Frame& frame, Time now) { node_.accept(frame, now); }
  void step(Time now, Frames& frames);
  /// What to send from; nothing while there is none: then nothing else may be sent.
  [[nodiscard]] std::optional<std::uint8_t> address() const { return node_.address(); }

 private:
  std::string_view model_;
  std::vector<std::uint32_t> sends_;
  std::vector<std::uint32_t> reads_;
  n2k::Node node_;
};

}  // namespace earshot::hil
