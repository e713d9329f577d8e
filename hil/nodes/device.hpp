#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/frame.hpp"

namespace earshot::hil {

/// What a device sends, in this order.
using Frames = std::vector<n2k::Frame>;

/// A device on the vehicle's CAN bus, emulated: frames and time go in, frames come out. It has no bus and no clock of its own.
class Device {
 public:
  Device() = default;
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// As a person calls it: "compass".
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// That it sends from; nothing while it has none.
  [[nodiscard]] virtual std::optional<std::uint8_t> address() const = 0;
  /// Every frame on the bus but its own.
  virtual void accept(const n2k::Frame& frame, Time now) = 0;
  /// Adds what it sends now. To be called at least every 100 ms of its time, which never goes back.
  virtual void step(Time now, Frames& frames) = 0;
};

}  // namespace earshot::hil
