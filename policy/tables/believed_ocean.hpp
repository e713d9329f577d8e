#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/ocean/environment.hpp"

namespace earshot::tables {

/// One ocean that a mission may meet, and the file that says so.
struct BelievedOcean {
  std::filesystem::path file;
  ocean::Environment environment;
  std::string detail = {};                   ///< " 3": of several of one name in a file, the file's own apart
  std::filesystem::path field_library = {};  ///< loss computed beforehand, instead of the environment's own; empty: none
};

/// The files that are meant: those named, and of a folder every `.toml` in it, by name.
/// Throws host::BadInput for a folder without any.
[[nodiscard]] std::vector<std::filesystem::path> environment_files(const std::vector<std::string>& named);

/// The oceans of an environment file: its own, or its field library's, then those of its [[oceans]] and [family]. Conditions are none of
/// theirs.
/// Throws host::BadInput with everything that is wrong with the file.
[[nodiscard]] std::vector<BelievedOcean> oceans_in(const std::filesystem::path& file);

/// Throws host::BadInput, naming two files and their frequencies, unless all sources have the same one: tables are of one frequency.
void require_one_frequency(const std::vector<BelievedOcean>& oceans);

}  // namespace earshot::tables
