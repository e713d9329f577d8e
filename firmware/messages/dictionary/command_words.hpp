#pragma once

#include "firmware/messages/dictionary/words.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::messages {

template <>
struct WordsOf<Order> {
  static constexpr std::string_view kUnknown = "an unknown order";
  static constexpr bool kMayBeUnknown = true;  ///< who gave it is to hear so
  static constexpr auto kInRecords = &Word<Order>::name;
  static constexpr auto kTable = std::to_array<Word<Order>>({
      {Order::kStart, "start", "START", "START"},
      {Order::kComplete, "complete", "COMPLETE", "COMPLETE"},
      {Order::kAbort, "abort", "ABORT", "ABORT"},
      {Order::kListen, "listen", "LISTEN", "LISTEN"},
      {Order::kPause, "pause", "PAUSE", "PAUSE"},
      {Order::kResume, "resume", "RESUME", "RESUME"},
      {Order::kTighten, "tighten", "TIGHTEN", "TIGHTEN"},
  });
};

template <>
struct WordsOf<CommandOutcome> {
  static constexpr std::string_view kUnknown = "an unknown outcome";
  static constexpr auto kInRecords = &Word<CommandOutcome>::words;
  static constexpr auto kTable = std::to_array<Word<CommandOutcome>>({
      {CommandOutcome::kObeyed, "obeyed", "obeyed", "obeyed"},
      {CommandOutcome::kRepeated, "repeated", "repeated", "repeated"},
      {CommandOutcome::kTooOld, "too_old", "too old", "refused: too old"},
      {CommandOutcome::kExpired, "expired", "expired", "refused: expired"},
      {CommandOutcome::kNotInThisState, "not_in_this_state", "not in this state", "refused: not in this state"},
      {CommandOutcome::kUnknownOrder, "unknown_order", "unknown order", "refused: unknown"},
      {CommandOutcome::kNotConfigured, "not_configured", "not configured", "refused: no mission"},
      {CommandOutcome::kOutOfOrder, "out_of_order", "out of order", "refused: out of order"},
      {CommandOutcome::kNotVerified, "not_verified", "not verified", "refused: not verified"},
      {CommandOutcome::kNotTighter, "not_tighter", "not tighter", "refused: not tighter"},
      {CommandOutcome::kAutopilotSilent, "autopilot_silent", "autopilot silent", "refused: the autopilot is silent"},
      {CommandOutcome::kOldMark, "old_mark", "old mark", "refused: its mark lacks the vehicle's challenge"},
      {CommandOutcome::kUnreadable, "unreadable", "unreadable", "refused: unreadable"},
      {CommandOutcome::kObeyedNotDurable, "obeyed_not_durable", "obeyed, not durable", "obeyed, not durable"},
  });
};

}  // namespace earshot::messages
