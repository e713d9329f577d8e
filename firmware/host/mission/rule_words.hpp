#pragma once

#include <string>

#include "firmware/config/safety.hpp"

namespace earshot::host {

/// "15.5"
[[nodiscard]] std::string shortly(double value);

/// As a mission file says it: "battery_percent below 15 for 10 s then return".
[[nodiscard]] std::string to_string(const config::Rule& rule);

/// As a person would, with the mission file's key in brackets: "return to the safe point once the battery's charge is below 15 % for 10 s
/// (battery_percent), and until the mission ends".
[[nodiscard]] std::string sentence_of(const config::Rule& rule);

}  // namespace earshot::host
