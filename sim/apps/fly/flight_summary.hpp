#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace earshot::fly {

/// The summary of a flight for the terminal: the verdict, that it was a simulation, where, how deep, how fast and for which source it
/// searched, and each result with what it means. Lines of at most 100 columns. A summary of an earlier version knows less.
[[nodiscard]] std::string to_string_of_summary(const nlohmann::json& summary);

}  // namespace earshot::fly
