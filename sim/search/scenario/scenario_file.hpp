#pragma once

#include <filesystem>

#include "sim/search/scenario/scenario.hpp"

namespace earshot::search {

/// Reads an environment file with the tables of a search in it: [conditions], [[oceans]], [family], [field_library]; README.md lists their
/// keys. Throws host::BadInput with everything that is wrong with the file, one line each. Oracle: ScenarioFile.*
[[nodiscard]] Scenario load_scenario(const std::filesystem::path& path);

}  // namespace earshot::search
