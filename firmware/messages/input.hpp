#pragma once

#include <cstdint>
#include <variant>

#include "firmware/core/time.hpp"
#include "firmware/messages/autopilot_status.hpp"
#include "firmware/messages/bearing_measurement.hpp"
#include "firmware/messages/hydrophone_status.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/messages/port_report.hpp"
#include "firmware/messages/snr_measurement.hpp"
#include "firmware/messages/unsent_setpoints.hpp"
#include "firmware/messages/vehicle_status.hpp"

namespace earshot::messages {

/// All that ever enters the runtime: one value, with where it came from and when. Nothing of it has been judged but that its bytes follow
/// their format; the sender's own date is in the value.
struct Input {
  Time arrival;                ///< mission clock; never goes back from one input to the next
  std::uint8_t port = 0;       ///< index of the port that brought it
  std::uint64_t sequence = 0;  ///< counts the inputs of all ports, from 0
  std::variant<Navigation, SnrMeasurement, OperatorCommand, PortReport, VehicleStatus, AutopilotStatus, HydrophoneStatus,
               BearingMeasurement, UnsentSetpoints>
      value;
};

}  // namespace earshot::messages
