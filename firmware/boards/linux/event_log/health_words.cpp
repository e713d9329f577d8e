#include "firmware/boards/linux/event_log/health_words.hpp"

#include "firmware/host/text/numbers.hpp"
#include "firmware/messages/dictionary/health_words.hpp"

namespace earshot::board {

namespace {

std::string state_and(const char* reason, const messages::Health& health) {
  std::string text = messages::to_string(health.state);
  if (health.end_reason != messages::EndReason::kNone) text += std::string(", ") + reason;
  if (!counts_steps(health.end_reason)) return text;
  return text + ", after " + host::counted(health.steps_taken, "step");
}

}  // namespace

std::string to_string(const messages::Health& health) {
  return state_and(messages::to_string(health.end_reason), health);
}

std::string to_string(const messages::Health& health, messages::MissionState found_in) {
  const bool was_over = found_in == messages::MissionState::kDone || found_in == messages::MissionState::kAbort;
  const bool is_own = !was_over && health.end_reason == messages::EndReason::kOperatorAbort;
  return is_own ? state_and(kProgramStopped, health) : to_string(health);
}

}  // namespace earshot::board
