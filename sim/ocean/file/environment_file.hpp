#pragma once

#include <filesystem>

#include "sim/ocean/environment.hpp"

namespace earshot::ocean {

/// Reads an environment from a TOML file; `sim/ocean/environments/munk_flat.toml` shows and explains every key.
///
/// Throws host::BadInput with everything that is wrong with the file, one line each.
/// Oracle: EnvironmentFile.*
[[nodiscard]] Environment load_environment(const std::filesystem::path& path);

}  // namespace earshot::ocean
