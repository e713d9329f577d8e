#pragma once

#include <string_view>

#include "firmware/core/time.hpp"
#include "firmware/host/journal/record_ring.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"

namespace earshot::board {

/// What a turn says, in the order and with the weights in which it stands in the journal.
/// @param is_new_state  of the mission, since the turn before
/// @param keep          called with channel, message and weight of each record
template <class Keep>
void for_each_record(Time turn, const runtime::Outputs& outputs, bool is_new_state, Keep&& keep) {
  using host::Weight;
  if (outputs.setpoint) keep(wire::kJournalledSetpointChannel, wire::to_message(*outputs.setpoint, turn), Weight::kSteering);
  if (outputs.decision) keep(wire::kDecisionChannel, wire::to_message(*outputs.decision), Weight::kSteering);
  for (const messages::SafetyEvent& event : outputs.safety_events)
    keep(wire::kSafetyEventChannel, wire::to_message(event), Weight::kSteering);
  for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements)
    keep(wire::kAcknowledgementChannel, wire::to_message(acknowledgement),
         messages::was_obeyed(acknowledgement.outcome) ? Weight::kOrder : Weight::kStream);
  keep(wire::kHealthChannel, wire::to_message(outputs.health, turn), is_new_state ? Weight::kOrder : Weight::kStream);
}

}  // namespace earshot::board
