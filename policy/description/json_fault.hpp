#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace earshot::description {

/// What is wrong with JSON that somebody gave, in our words and on one line: "not JSON from byte 17 on, or cut short", "has no \"seed\"",
/// "holds a text where a number belongs". Oracle: JsonFault.*
[[nodiscard]] std::string to_string(const nlohmann::json::exception& fault);

}  // namespace earshot::description
