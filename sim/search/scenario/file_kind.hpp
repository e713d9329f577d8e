#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "firmware/host/toml/table_reader.hpp"

namespace earshot::search {

/// What a TOML file of Earshot is, by its keys.
enum class FileKind : std::uint8_t {
  kOther,        ///< none of these, or no readable TOML: whoever reads it says what is wrong
  kEnvironment,  ///< an ocean
  kWorld,        ///< an environment and conditions to test policies in
  kMission,      ///< what a vehicle is asked to do
};

[[nodiscard]] FileKind kind_of(const host::TomlFile& file);
[[nodiscard]] FileKind kind_of(const std::filesystem::path& path);

/// One kind of file given for another is said in one line, instead of by every key that the other has not.
/// @param option  that named it; empty: nobody knows
/// @param file    what its reader reads it from, too: no file is parsed twice
/// @throws BadInput where the file is of a kind that is known and is not `wanted`: "--world ocean.toml: is an environment ..., not a world
/// ..." Oracle: FileKind.*
void require_kind(const std::string& option, const host::TomlFile& file, FileKind wanted);

}  // namespace earshot::search
