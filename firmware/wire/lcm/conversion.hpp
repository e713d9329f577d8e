#pragma once

#include <cstdint>
#include <optional>

#include "earshot/autopilot_status_t.hpp"
#include "earshot/bearing_t.hpp"
#include "earshot/challenge_t.hpp"
#include "earshot/command_acknowledgement_t.hpp"
#include "earshot/decision_t.hpp"
#include "earshot/detection_t.hpp"
#include "earshot/health_t.hpp"
#include "earshot/hydrophone_status_t.hpp"
#include "earshot/mission_t.hpp"
#include "earshot/nav_state_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "earshot/port_report_t.hpp"
#include "earshot/safety_event_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "earshot/snr_estimate_t.hpp"
#include "earshot/unsent_setpoints_t.hpp"
#include "earshot/vehicle_status_t.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/autopilot_status.hpp"
#include "firmware/messages/bearing_measurement.hpp"
#include "firmware/messages/challenge.hpp"
#include "firmware/messages/decision.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/hydrophone_status.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/messages/port_report.hpp"
#include "firmware/messages/safety_event.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/messages/snr_measurement.hpp"
#include "firmware/messages/sound_detection.hpp"
#include "firmware/messages/unsent_setpoints.hpp"
#include "firmware/messages/vehicle_status.hpp"

namespace earshot::wire {

// The runtime's inputs and outputs as LCM messages, as they go over the bus and into the journal, and back.
// (The generated types live in namespace earshot, where lcm-gen puts them.)

[[nodiscard]] nav_state_t to_message(const messages::Navigation& navigation);
[[nodiscard]] snr_estimate_t to_message(const messages::SnrMeasurement& measurement);
[[nodiscard]] bearing_t to_message(const messages::BearingMeasurement& measurement);
[[nodiscard]] vehicle_status_t to_message(const messages::VehicleStatus& status);
[[nodiscard]] autopilot_status_t to_message(const messages::AutopilotStatus& status);
[[nodiscard]] hydrophone_status_t to_message(const messages::HydrophoneStatus& status);
[[nodiscard]] safety_event_t to_message(const messages::SafetyEvent& event);
[[nodiscard]] operator_command_t to_message(const messages::OperatorCommand& command);
[[nodiscard]] command_acknowledgement_t to_message(const messages::CommandAcknowledgement& acknowledgement);
[[nodiscard]] challenge_t to_message(const messages::ToldChallenge& told);
[[nodiscard]] port_report_t to_message(const messages::PortReport& report);
[[nodiscard]] unsent_setpoints_t to_message(const messages::UnsentSetpoints& unsent);
[[nodiscard]] setpoint_t to_message(const messages::Setpoint& setpoint, Time now);
[[nodiscard]] decision_t to_message(const messages::Decision& decision);
[[nodiscard]] detection_t to_message(const messages::SoundDetection& detection);
[[nodiscard]] health_t to_message(const messages::Health& health, Time now);
/// Policy and build are left to who knows them.
[[nodiscard]] mission_t to_message(const config::Mission& mission, Time now);

// Values are as they came: the runtime judges them.
[[nodiscard]] messages::Navigation from_message(const nav_state_t& message);
[[nodiscard]] messages::SnrMeasurement from_message(const snr_estimate_t& message);
[[nodiscard]] messages::BearingMeasurement from_message(const bearing_t& message);
/// That the decision was made by.
[[nodiscard]] std::optional<messages::Bearing> bearing_in(const decision_t& message);
[[nodiscard]] messages::VehicleStatus from_message(const vehicle_status_t& message);
[[nodiscard]] messages::AutopilotStatus from_message(const autopilot_status_t& message);
[[nodiscard]] messages::HydrophoneStatus from_message(const hydrophone_status_t& message);
[[nodiscard]] messages::SafetyEvent from_message(const safety_event_t& message);
[[nodiscard]] messages::OperatorCommand from_message(const operator_command_t& message);
[[nodiscard]] messages::ToldChallenge from_message(const challenge_t& message);
[[nodiscard]] messages::Setpoint from_message(const setpoint_t& message);
[[nodiscard]] messages::PortReport from_message(const port_report_t& message);
[[nodiscard]] messages::UnsentSetpoints from_message(const unsent_setpoints_t& message);
[[nodiscard]] config::Mission from_message(const mission_t& message);

}  // namespace earshot::wire
