#include "firmware/boards/linux/event_log/health_words.hpp"

#include "firmware/host/journal/words/sentences.hpp"

namespace earshot::board {

std::string to_string(const messages::Health& health) {
  return journal::to_string(health.state, health.end_reason, health.steps_taken, journal::AbortedBy::kOperator);
}

std::string to_string(const messages::Health& health, messages::MissionState found_in) {
  const bool was_over = found_in == messages::MissionState::kDone || found_in == messages::MissionState::kAbort;
  if (was_over) return to_string(health);
  return journal::to_string(health.state, health.end_reason, health.steps_taken, journal::AbortedBy::kProgram);
}

}  // namespace earshot::board
