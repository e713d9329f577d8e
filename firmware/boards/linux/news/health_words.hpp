#pragma once

#include <string>

#include "firmware/messages/health.hpp"

namespace earshot::board {

/// "DONE, the source is reached, after 37 steps"; "SEARCH, after 3 steps"
[[nodiscard]] std::string to_string(const messages::Health& health);

}  // namespace earshot::board
