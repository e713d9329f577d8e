#include "firmware/boards/linux/news/health_words.hpp"

namespace earshot::board {

const char* to_string(messages::MissionState state) {
  switch (state) {
    case messages::MissionState::kStandby:
      return "STANDBY";
    case messages::MissionState::kSearch:
      return "SEARCH";
    case messages::MissionState::kDone:
      return "DONE";
    case messages::MissionState::kAbort:
      return "ABORT";
  }
  return "?";
}

const char* to_string(messages::EndReason reason) {
  switch (reason) {
    case messages::EndReason::kNone:
      return "not over";
    case messages::EndReason::kCompleted:
      return "the source is reached";
    case messages::EndReason::kStepsUsedUp:
      return "all steps are taken";
    case messages::EndReason::kOperatorAbort:
      return "an operator aborted it";
    case messages::EndReason::kNavigationStale:
      return "navigation went silent";
    case messages::EndReason::kSnrStale:
      return "the SNR estimate went silent";
    case messages::EndReason::kLeftOperatingArea:
      return "the vehicle left its operating area";
    case messages::EndReason::kTimeUsedUp:
      return "its time is used up";
  }
  return "?";
}

std::string to_string(const messages::Health& health) {
  std::string text = to_string(health.state);
  if (health.end_reason != messages::EndReason::kNone) text += std::string(", ") + to_string(health.end_reason);
  return text + ", after " + std::to_string(health.steps_taken) + " steps";
}

}  // namespace earshot::board
