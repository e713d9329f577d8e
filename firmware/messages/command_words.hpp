#pragma once

#include "firmware/messages/operator_command.hpp"

namespace earshot::messages {

/// "START"
[[nodiscard]] constexpr const char* to_string(Order order) {
  switch (order) {
    case Order::kStart:
      return "START";
    case Order::kComplete:
      return "COMPLETE";
    case Order::kAbort:
      return "ABORT";
    case Order::kListen:
      return "LISTEN";
    case Order::kPause:
      return "PAUSE";
    case Order::kResume:
      return "RESUME";
    case Order::kTighten:
      return "TIGHTEN";
  }
  return "an unknown order";
}

/// "obeyed"; "refused: too old"
[[nodiscard]] constexpr const char* to_string(CommandOutcome outcome) {
  switch (outcome) {
    case CommandOutcome::kObeyed:
      return "obeyed";
    case CommandOutcome::kRepeated:
      return "repeated";
    case CommandOutcome::kTooOld:
      return "refused: too old";
    case CommandOutcome::kExpired:
      return "refused: expired";
    case CommandOutcome::kNotInThisState:
      return "refused: not in this state";
    case CommandOutcome::kUnknownOrder:
      return "refused: unknown";
    case CommandOutcome::kNotConfigured:
      return "refused: no mission";
    case CommandOutcome::kOutOfOrder:
      return "refused: out of order";
    case CommandOutcome::kNotVerified:
      return "refused: not verified";
    case CommandOutcome::kNotTighter:
      return "refused: not tighter";
    case CommandOutcome::kAutopilotSilent:
      return "refused: the autopilot is silent";
    case CommandOutcome::kOldMark:
      return "refused: its mark lacks the vehicle's challenge";
    case CommandOutcome::kUnreadable:
      return "refused: unreadable";
    case CommandOutcome::kObeyedNotDurable:
      return "obeyed, not durable";
  }
  return "refused";
}

}  // namespace earshot::messages
