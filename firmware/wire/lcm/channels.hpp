#pragma once

#include <string_view>

namespace earshot::wire {

// LCM channels, one type each (firmware/wire/lcm/*.lcm).

inline constexpr std::string_view kNavStateChannel = "EARSHOT_NAV_STATE";                ///< nav_state_t, to the runtime
inline constexpr std::string_view kSnrEstimateChannel = "EARSHOT_SNR_ESTIMATE";          ///< snr_estimate_t, to the runtime
inline constexpr std::string_view kOperatorCommandChannel = "EARSHOT_OPERATOR_COMMAND";  ///< operator_command_t, to the runtime
inline constexpr std::string_view kSetpointChannel = "EARSHOT_SETPOINT";                 ///< setpoint_t, from the runtime
inline constexpr std::string_view kDecisionChannel = "EARSHOT_DECISION";                 ///< decision_t, from the runtime
inline constexpr std::string_view kHealthChannel = "EARSHOT_HEALTH";                     ///< health_t, from the runtime

}  // namespace earshot::wire
