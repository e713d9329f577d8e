#pragma once

#include <string>

#include "firmware/messages/health.hpp"

namespace earshot::board {

/// "DONE, completed, the source is reached, after 37 steps"; "SEARCH, after 3 steps"
[[nodiscard]] std::string to_string(const messages::Health& health);
/// The same of a flight that was told to stop. @param found_in  the state that it was in then: of a mission that was not over, an abort is
/// this program's own
[[nodiscard]] std::string to_string(const messages::Health& health, messages::MissionState found_in);

}  // namespace earshot::board
