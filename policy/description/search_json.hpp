#pragma once

#include <nlohmann/json.hpp>

#include "policy/description/search_description.hpp"

namespace earshot::description {

/// Adds the description's keys to an object; checkpoints hold the same ones.
void write(const SearchDescription& description, nlohmann::ordered_json& json);

/// The description that an object's keys hold. Throws host::BadInput for what is out of range, nlohmann::json::exception for what
/// is missing or of another type.
[[nodiscard]] SearchDescription read(const nlohmann::ordered_json& json);

}  // namespace earshot::description
