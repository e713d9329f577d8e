#pragma once

#include <filesystem>
#include <string>

#include "policy/own_search/own_search.hpp"

namespace earshot::own_search {

inline constexpr const char* kMissionFile = "mission.toml";
inline constexpr const char* kOceanFile = "ocean.toml";
inline constexpr const char* kRunFile = "run";
inline constexpr const char* kReadmeFile = "README.md";

/// The mission of the bus that ships, with this search's values; it names policy, tables and key by paths that are valid from anywhere, or,
/// where these do not fit, those beside it.
[[nodiscard]] std::string mission_text(const OwnSearch& search, FliesBy by);
/// The mission's tables for what hydrophone, battery and fence need, of a search that has them; empty for one that has none.
[[nodiscard]] std::string extra_tables(const OwnSearch& search);
/// The ocean that ships, with this search's values.
[[nodiscard]] std::string ocean_text(const OwnSearch& search);
/// A script that starts `earshotd` for the mission beside it, as a service would.
[[nodiscard]] std::string run_text();
/// @param folder  absolute
[[nodiscard]] std::string readme_text(const OwnSearch& search, FliesBy by, const std::filesystem::path& folder);
/// The command that makes tables of the search's own ocean, where none that ship are of the search. @param folder  absolute
[[nodiscard]] std::string tables_command(const OwnSearch& search, const std::filesystem::path& folder);

}  // namespace earshot::own_search
