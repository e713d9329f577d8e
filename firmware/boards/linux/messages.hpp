#pragma once

#include <cstdint>

#include "earshot/decision_t.hpp"
#include "earshot/health_t.hpp"
#include "earshot/nav_state_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "earshot/snr_estimate_t.hpp"
#include "firmware/core/time.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

// The runtime's inputs and outputs as LCM messages, as they go over the bus and into the journal.
// (The messages live in namespace earshot, where lcm-gen puts them.)

[[nodiscard]] nav_state_t to_message(const runtime::Navigation& navigation);
[[nodiscard]] snr_estimate_t to_message(const runtime::SnrEstimate& estimate);
[[nodiscard]] operator_command_t to_message(runtime::OperatorCommand command, Time now);
[[nodiscard]] setpoint_t to_message(const runtime::Setpoint& setpoint, Time now);
[[nodiscard]] decision_t to_message(const runtime::Decision& decision);
[[nodiscard]] health_t to_message(const runtime::Outputs& outputs, std::uint64_t bus_refused, Time now);

// Values are as they came: the runtime judges them.
[[nodiscard]] runtime::Navigation from_message(const nav_state_t& message);
[[nodiscard]] runtime::SnrEstimate from_message(const snr_estimate_t& message);
[[nodiscard]] runtime::OperatorCommand from_message(const operator_command_t& message);

}  // namespace earshot::board
