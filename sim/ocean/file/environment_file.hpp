#pragma once

#include <filesystem>
#include <string>

#include "sim/ocean/environment.hpp"
#include "sim/ocean/file/environment_keys.hpp"

namespace earshot::ocean {

/// Reads an ocean from a TOML file; `sim/ocean/environments/munk_flat.toml` shows and explains every key. A file that says also what a
/// search in it meets is read by search::load_scenario.
///
/// Throws host::BadInput with everything that is wrong with the file, one line each.
/// Oracle: EnvironmentFile.*
[[nodiscard]] Environment load_environment(const std::filesystem::path& path);

/// Reads an ocean from the text of such a file. Data files that it names are relative to the current folder.
/// @param name  stands for the file in what is wrong with it
[[nodiscard]] Environment environment_of_text(const std::string& name, const std::string& text);

/// The ocean that the keys of the file at `path` describe: reads the data files they name. Throws host::BadInput or netcdf::FileError.
[[nodiscard]] Environment environment_of(const std::filesystem::path& path, const EnvironmentKeys& keys);

}  // namespace earshot::ocean
