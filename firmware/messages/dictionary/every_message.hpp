#pragma once

// The lists of all messages.
#include "firmware/messages/dictionary/board_fields.hpp"
#include "firmware/messages/dictionary/command_fields.hpp"
#include "firmware/messages/dictionary/input_fields.hpp"
#include "firmware/messages/dictionary/journal_fields.hpp"
#include "firmware/messages/dictionary/mission_fields.hpp"
#include "firmware/messages/dictionary/output_fields.hpp"

namespace earshot::messages {

using EveryMessage =
    Types<Navigation, SnrMeasurement, BearingMeasurement, VehicleStatus, AutopilotStatus, HydrophoneStatus, PortReport, UnsentSetpoints,
          OperatorCommand, CommandAcknowledgement, PublishedChallenge, Setpoint, Decision, SafetyEvent, Health, SoundDetection,
          MissionRecord, JournalPart, JournalResumed, ControllerTrouble, ClosingRecord, BoardReport>;

}  // namespace earshot::messages
