#pragma once

#include <filesystem>

#include "sim/ocean/environment.hpp"
#include "sim/ocean/file/environment_keys.hpp"

namespace earshot::ocean {

/// Reads an ocean from a TOML file; `sim/ocean/environments/munk_flat.toml` shows and explains every key. A file that says also what a
/// search in it meets is read by search::load_scenario.
///
/// Throws host::BadInput with everything that is wrong with the file, one line each.
/// Oracle: EnvironmentFile.*
[[nodiscard]] Environment load_environment(const std::filesystem::path& path);

/// The ocean that the keys of the file at `path` describe: reads the data files they name. Throws host::BadInput or netcdf::FileError.
[[nodiscard]] Environment environment_of(const std::filesystem::path& path, const EnvironmentKeys& keys);

}  // namespace earshot::ocean
