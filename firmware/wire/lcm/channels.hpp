#pragma once

#include <string_view>

namespace earshot::wire {

// LCM channels, one type each (firmware/wire/lcm/*.lcm).

// To the runtime.
inline constexpr std::string_view kNavStateChannel = "EARSHOT_NAV_STATE";                  ///< nav_state_t
inline constexpr std::string_view kSnrEstimateChannel = "EARSHOT_SNR_ESTIMATE";            ///< snr_estimate_t
inline constexpr std::string_view kBearingChannel = "EARSHOT_BEARING";                     ///< bearing_t
inline constexpr std::string_view kOperatorCommandChannel = "EARSHOT_OPERATOR_COMMAND";    ///< operator_command_t
inline constexpr std::string_view kVehicleStatusChannel = "EARSHOT_VEHICLE_STATUS";        ///< vehicle_status_t
inline constexpr std::string_view kAutopilotStatusChannel = "EARSHOT_AUTOPILOT_STATUS";    ///< autopilot_status_t
inline constexpr std::string_view kHydrophoneStatusChannel = "EARSHOT_HYDROPHONE_STATUS";  ///< hydrophone_status_t
inline constexpr std::string_view kHydrophoneBlockChannel = "EARSHOT_HYDROPHONE_BLOCK";    ///< hydrophone_block_t; beside the runtime

// From the runtime.
inline constexpr std::string_view kSetpointChannel = "EARSHOT_SETPOINT";                        ///< setpoint_t
inline constexpr std::string_view kDecisionChannel = "EARSHOT_DECISION";                        ///< decision_t
inline constexpr std::string_view kHealthChannel = "EARSHOT_HEALTH";                            ///< health_t
inline constexpr std::string_view kAcknowledgementChannel = "EARSHOT_COMMAND_ACKNOWLEDGEMENT";  ///< command_acknowledgement_t
inline constexpr std::string_view kChallengeChannel = "EARSHOT_CHALLENGE";                      ///< challenge_t
inline constexpr std::string_view kSafetyEventChannel = "EARSHOT_SAFETY_EVENT";                 ///< safety_event_t
inline constexpr std::string_view kDetectionChannel = "EARSHOT_DETECTION";                      ///< detection_t; in no journal

// In journals only.
inline constexpr std::string_view kMissionChannel = "EARSHOT_MISSION";  ///< mission_t
inline constexpr std::string_view kPolicyChannel = "EARSHOT_POLICY";    ///< bytes of a .policy file
inline constexpr std::string_view kTablesChannel = "EARSHOT_TABLES";    ///< bytes of a .tables file
/// setpoint_t; not kSetpointChannel, so that a journal that is played back to a bus steers no autopilot
inline constexpr std::string_view kJournalledSetpointChannel = "EARSHOT_SETPOINT.0";
inline constexpr std::string_view kPortReportChannel = "EARSHOT_PORT_REPORT";                ///< port_report_t
inline constexpr std::string_view kUnsentSetpointsChannel = "EARSHOT_UNSENT_SETPOINTS";      ///< unsent_setpoints_t
inline constexpr std::string_view kControllerTroubleChannel = "EARSHOT_CONTROLLER_TROUBLE";  ///< controller_trouble_t
inline constexpr std::string_view kJournalEndChannel = "EARSHOT_JOURNAL_END";                ///< journal_end_t
inline constexpr std::string_view kJournalPartChannel = "EARSHOT_JOURNAL_PART";              ///< journal_part_t
inline constexpr std::string_view kJournalResumedChannel = "EARSHOT_JOURNAL_RESUMED";        ///< journal_resumed_t

}  // namespace earshot::wire
