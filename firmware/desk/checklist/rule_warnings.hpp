#pragma once

#include <string>
#include <vector>

#include "firmware/config/mission.hpp"

namespace earshot::board {

/// What is allowed and still worth a thought of a mission's own rules, one line each: those that act in every search that goes as it is
/// planned, and those that go by the word of somebody whose silence no rule watches.
[[nodiscard]] std::vector<std::string> rule_warnings(const config::Mission& mission);

}  // namespace earshot::board
