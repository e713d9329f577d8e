#include "firmware/authority/command.hpp"

namespace earshot::authority {

using messages::Authority;
using messages::CommandOutcome;
using messages::MissionState;
using messages::Order;

CommandOutcome Command::obey(const messages::OperatorCommand& command, MissionState state, bool is_connected) {
  if (command.order == Order::kStart || command.order == Order::kListen) return order_search(command, state, is_connected);
  const bool commands_search = state == MissionState::kSearch && is_engaged_;
  const bool pauses = command.order == Order::kPause;
  if (!commands_search || (!pauses && !is_paused_)) return CommandOutcome::kNotInThisState;
  if (pauses && is_paused_) return CommandOutcome::kRepeated;
  is_paused_ = pauses;
  return CommandOutcome::kObeyed;
}

CommandOutcome Command::order_search(const messages::OperatorCommand& command, MissionState state, bool is_connected) {
  const bool listens = command.order == Order::kListen;
  if (state == MissionState::kSearch && !is_engaged_ && !listens) {
    if (!is_connected) return CommandOutcome::kAutopilotSilent;
    is_engaged_ = true;
    return CommandOutcome::kObeyed;
  }
  if (state != MissionState::kStandby) return CommandOutcome::kNotInThisState;
  until_ = command.expiry;
  is_to_listen_ = listens;
  return CommandOutcome::kObeyed;
}

void Command::begin() {
  until_.reset();
  is_engaged_ = !is_to_listen_;
}

bool is_connected(const config::Authority& settings, const std::optional<messages::AutopilotStatus>& autopilot, Time now) {
  if (settings.autopilot_timeout == Duration{}) return true;
  return autopilot && now - autopilot->time <= settings.autopilot_timeout;
}

Authority state_of(const Command& command, MissionState state, bool is_connected) {
  if (state == MissionState::kAbort) return Authority::kAbort;
  if (command.is_engaged()) return Authority::kCommand;
  if (state == MissionState::kSearch) return Authority::kListen;
  return is_connected ? Authority::kStandby : Authority::kDisconnected;
}

}  // namespace earshot::authority
