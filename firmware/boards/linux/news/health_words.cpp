#include "firmware/boards/linux/news/health_words.hpp"

#include "firmware/messages/health_words.hpp"

namespace earshot::board {

std::string to_string(const messages::Health& health) {
  std::string text = messages::to_string(health.state);
  if (health.end_reason != messages::EndReason::kNone) text += std::string(", ") + messages::to_string(health.end_reason);
  return text + ", after " + std::to_string(health.steps_taken) + " steps";
}

}  // namespace earshot::board
