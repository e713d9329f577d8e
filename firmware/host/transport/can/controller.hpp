#pragma once

#include <cstdint>

#include "firmware/wire/n2k/node/node.hpp"

struct can_frame;

namespace earshot::host {

/// What the controller's error frames told; they only grow.
struct CanErrorCounters {
  std::uint64_t frames = 0;     ///< error frames, of every kind
  std::uint64_t bus_off = 0;    ///< times that it left the bus
  std::uint64_t restarted = 0;  ///< times that it came back
  std::uint64_t passive = 0;    ///< times that it became error-passive
  std::uint64_t warning = 0;    ///< times that it reached the warning level
  std::uint64_t not_acknowledged = 0;
  std::uint64_t send_timeouts = 0;
  std::uint64_t overflows = 0;  ///< times that the controller itself lost frames, because its own memory was full
};

/// The state of a CAN controller, as its error frames tell it: error-active until they say otherwise.
class CanController {
 public:
  /// What to ask the kernel for (CAN_RAW_ERR_FILTER). Single bit errors are not among it: a broken bus has thousands of them a second.
  static const std::uint32_t kErrorMask;

  void accept_error(const can_frame& frame);
  /// A frame of somebody else's arrived: who is bus-off hears nothing.
  void note_reception();
  /// The kernel has no carrier for us: it is bus-off, though we did not hear of it.
  void note_bus_off();
  /// Opened anew.
  void restart() { state_ = n2k::ControllerState::kErrorActive, is_warned_ = false; }

  [[nodiscard]] n2k::ControllerState state() const { return state_; }
  [[nodiscard]] bool is_bus_off() const { return state_ == n2k::ControllerState::kBusOff; }
  /// Error-active still, but with 96 errors counted: something is wrong with the bus.
  [[nodiscard]] bool is_warned() const { return is_warned_; }
  [[nodiscard]] const CanErrorCounters& counters() const { return counters_; }

 private:
  void accept_controller_problem(unsigned problem);

  n2k::ControllerState state_ = n2k::ControllerState::kErrorActive;
  bool is_warned_ = false;
  CanErrorCounters counters_;
};

}  // namespace earshot::host
