#pragma once

#include "earshot/command_acknowledgement_t.hpp"
#include "earshot/decision_t.hpp"
#include "earshot/health_t.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/decision.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::wire {

// What a runtime on another computer said, back from its LCM messages: to_message() of it gives the same message again. Counts are cut to
// what there is room for.

/// Of a declaration that the source is found only what the message bears comes back: not which look it was, nor how many near ones.
[[nodiscard]] messages::Decision from_message(const decision_t& message);
[[nodiscard]] messages::Health from_message(const health_t& message);
/// @param port  that it leaves by, which no message bears
[[nodiscard]] messages::CommandAcknowledgement from_message(const command_acknowledgement_t& message, std::uint8_t port);

}  // namespace earshot::wire
