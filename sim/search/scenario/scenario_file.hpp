#pragma once

#include <filesystem>
#include <string>

#include "sim/search/scenario/scenario.hpp"

namespace earshot::search {

/// Reads an environment file with the tables of a search in it: [conditions], [[oceans]], [family], [field_library]; README.md lists their
/// keys. Throws host::BadInput with everything that is wrong with the file, one line each. Oracle: ScenarioFile.*
/// @param option  that named the file, where one did
[[nodiscard]] Scenario load_scenario(const std::filesystem::path& path, const std::string& option = {});

}  // namespace earshot::search
