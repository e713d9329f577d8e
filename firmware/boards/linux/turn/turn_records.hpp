#pragma once

#include <string_view>

#include "firmware/host/journal/record_ring.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::board {

/// What a turn says, in the order and with the priorities in which it stands in the journal.
/// @param is_new_state  of the mission, since the turn before
/// @param keep          called with channel, message and priority of each record; what holds no date of its own is dated with the turn
template <class Keep>
void for_each_record(const runtime::Outputs& outputs, bool is_new_state, Keep&& keep) {
  using host::Priority;
  if (outputs.setpoint) keep(wire::kJournalledSetpointChannel, *outputs.setpoint, Priority::kSteering);
  if (outputs.decision) keep(wire::kDecisionChannel, *outputs.decision, Priority::kSteering);
  for (const messages::SafetyEvent& event : outputs.safety_events) keep(wire::kSafetyEventChannel, event, Priority::kSteering);
  for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements)
    keep(wire::kAcknowledgementChannel, acknowledgement,
         messages::was_obeyed(acknowledgement.outcome) ? Priority::kOrder : Priority::kStream);
  keep(wire::kHealthChannel, outputs.health, is_new_state ? Priority::kOrder : Priority::kStream);
}

}  // namespace earshot::board
