#pragma once

#include <cstdint>
#include <filesystem>

#include "policy/own_search/own_search.hpp"

namespace earshot::own_search {

/// What becomes of an own search that stands there already.
enum class Earlier : std::uint8_t { kStays, kReplaced };

/// Writes a folder with mission, ocean, run file and README for a search, whole or not at all: it is made beside its place, judged as
/// `earshotd` and `earshot fly` would judge it, and renamed. An empty folder is filled.
/// @param earlier  kReplaced replaces a folder that holds nothing but files of this program and flights; its key, if it has one, and the
/// flights are kept
/// @return  what the mission is flown by: where tables are yet to be made, tables_command() makes them
/// @throws BadInput for a folder that holds anything else, or that is there and is to stay; for a search that would not be flown
/// Oracle: OwnFolder.*
FliesBy make_own_folder(const std::filesystem::path& folder, const OwnSearch& search, Earlier earlier);

}  // namespace earshot::own_search
