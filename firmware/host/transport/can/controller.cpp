#include "firmware/host/transport/can/controller.hpp"

#include <linux/can.h>
#include <linux/can/error.h>

namespace earshot::host {

const std::uint32_t CanController::kErrorMask = CAN_ERR_TX_TIMEOUT | CAN_ERR_CRTL | CAN_ERR_ACK | CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;

void CanController::accept_error(const can_frame& frame) {
  ++counters_.frames;
  if ((frame.can_id & CAN_ERR_TX_TIMEOUT) != 0) ++counters_.send_timeouts;
  if ((frame.can_id & CAN_ERR_ACK) != 0) ++counters_.not_acknowledged;
  if ((frame.can_id & CAN_ERR_RESTARTED) != 0) {
    ++counters_.restarted;
    restart();
  }
  if ((frame.can_id & CAN_ERR_CRTL) != 0 && frame.can_dlc >= 2) accept_controller_problem(frame.data[1]);
  if ((frame.can_id & CAN_ERR_BUSOFF) != 0) note_bus_off();
}

void CanController::accept_controller_problem(unsigned problem) {
  constexpr unsigned kOverflow = CAN_ERR_CRTL_RX_OVERFLOW;
  constexpr unsigned kWarning = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING;
  constexpr unsigned kPassive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
  if ((problem & kOverflow) != 0) ++counters_.overflows;
  if ((problem & kPassive) != 0) {
    if (state_ != n2k::ControllerState::kErrorPassive) ++counters_.passive;
    state_ = n2k::ControllerState::kErrorPassive;
  } else if ((problem & kWarning) != 0) {
    if (!is_warned_) ++counters_.warning;
    state_ = n2k::ControllerState::kErrorActive;
    is_warned_ = true;
  } else if ((problem & CAN_ERR_CRTL_ACTIVE) != 0) {
    restart();
  }
}

void CanController::note_reception() {
  if (is_bus_off()) restart();
}

void CanController::note_bus_off() {
  if (!is_bus_off()) ++counters_.bus_off;
  state_ = n2k::ControllerState::kBusOff;
}

}  // namespace earshot::host
