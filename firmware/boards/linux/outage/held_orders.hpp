#pragma once

#include <string_view>

#include "firmware/config/mission.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/safety_record/safety_record.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// What the safety record knows and a mission does not that goes on from its journal, for whose end there was no room on the disk.
struct HeldOrders {
  FixedVector<messages::OperatorCommand, 3> orders;  ///< this computer's own, that make up for it
  std::string_view impossible = {};                  ///< why no order can; empty: nothing is amiss
};

/// What was durable holds over the journal: an end of the mission, tightened limits, and, where the record is not the older of the two,
/// PAUSE and RESUME. A START that the journal does not know, or a released weight, no order makes up for.
/// @param last     outputs of its last turn
/// @param mission  as it is flown by the journal
/// Oracle: HeldOrders.*
[[nodiscard]] HeldOrders held_orders(const host::SafetyRecord& record, const runtime::Outputs& last, const config::Mission& mission,
                                     Time now);

/// The mission keeps every limit that the record says.
[[nodiscard]] bool keeps_limits_of(const host::SafetyRecord& record, const config::Mission& mission);

}  // namespace earshot::board
