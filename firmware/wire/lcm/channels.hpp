#pragma once

#include <string_view>

#include "firmware/messages/dictionary/every_message.hpp"
#include "firmware/messages/dictionary/sound_fields.hpp"

namespace earshot::wire {

// LCM channels, one type each (firmware/wire/lcm/*.lcm).

/// Where a message is told.
template <messages::IsDescribed Message>
inline constexpr std::string_view channel_of = messages::Described<Message>::kChannel;

// To the runtime.
inline constexpr std::string_view kNavStateChannel = channel_of<messages::Navigation>;                ///< nav_state_t
inline constexpr std::string_view kSnrEstimateChannel = channel_of<messages::SnrMeasurement>;         ///< snr_estimate_t
inline constexpr std::string_view kBearingChannel = channel_of<messages::BearingMeasurement>;         ///< bearing_t
inline constexpr std::string_view kOperatorCommandChannel = channel_of<messages::OperatorCommand>;    ///< operator_command_t
inline constexpr std::string_view kVehicleStatusChannel = channel_of<messages::VehicleStatus>;        ///< vehicle_status_t
inline constexpr std::string_view kAutopilotStatusChannel = channel_of<messages::AutopilotStatus>;    ///< autopilot_status_t
inline constexpr std::string_view kHydrophoneStatusChannel = channel_of<messages::HydrophoneStatus>;  ///< hydrophone_status_t
inline constexpr std::string_view kHydrophoneBlockChannel =
    channel_of<messages::HydrophoneBlock>;  ///< hydrophone_block_t; beside the runtime

// From the runtime.
inline constexpr std::string_view kSetpointChannel = channel_of<messages::Setpoint>;                       ///< setpoint_t
inline constexpr std::string_view kDecisionChannel = channel_of<messages::Decision>;                       ///< decision_t
inline constexpr std::string_view kHealthChannel = channel_of<messages::Health>;                           ///< health_t
inline constexpr std::string_view kAcknowledgementChannel = channel_of<messages::CommandAcknowledgement>;  ///< command_acknowledgement_t
inline constexpr std::string_view kChallengeChannel = channel_of<messages::PublishedChallenge>;            ///< challenge_t
inline constexpr std::string_view kSafetyEventChannel = channel_of<messages::SafetyEvent>;                 ///< safety_event_t
inline constexpr std::string_view kDetectionChannel = channel_of<messages::SoundDetection>;                ///< detection_t; in no journal

// In journals only.
inline constexpr std::string_view kMissionChannel = channel_of<messages::MissionRecord>;  ///< mission_t
inline constexpr std::string_view kPolicyChannel = "EARSHOT_POLICY";                      ///< bytes of a .policy file
inline constexpr std::string_view kTablesChannel = "EARSHOT_TABLES";                      ///< bytes of a .tables file
/// setpoint_t; not kSetpointChannel, so that a journal that is played back to a bus steers no autopilot
inline constexpr std::string_view kJournalledSetpointChannel = "EARSHOT_SETPOINT.0";
inline constexpr std::string_view kPortReportChannel = channel_of<messages::PortReport>;                ///< port_report_t
inline constexpr std::string_view kUnsentSetpointsChannel = channel_of<messages::UnsentSetpoints>;      ///< unsent_setpoints_t
inline constexpr std::string_view kControllerTroubleChannel = channel_of<messages::ControllerTrouble>;  ///< controller_trouble_t
inline constexpr std::string_view kJournalEndChannel = channel_of<messages::ClosingRecord>;             ///< journal_end_t
inline constexpr std::string_view kJournalPartChannel = channel_of<messages::JournalPart>;              ///< journal_part_t
inline constexpr std::string_view kJournalResumedChannel = channel_of<messages::JournalResumed>;        ///< journal_resumed_t

}  // namespace earshot::wire
