#pragma once

#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/messages/decision.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/safety/supervisor.hpp"

namespace earshot::runtime {

using Acknowledgements = FixedVector<messages::CommandAcknowledgement, config::kMaxAcknowledgements>;

/// The outputs of one turn of the loop.
struct Outputs {
  std::optional<messages::Setpoint> setpoint;  ///< none until a search begins: the autopilot is somebody else's
  std::optional<messages::Decision> decision;
  Acknowledgements acknowledgements;   ///< of the commands judged since the last turn
  safety::SafetyEvents safety_events;  ///< rules that began to act, or no longer do
  messages::Health health;
};

}  // namespace earshot::runtime
