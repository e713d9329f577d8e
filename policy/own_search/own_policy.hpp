#pragma once

#include <filesystem>

#include "policy/own_search/own_search.hpp"

namespace earshot::own_search {

inline constexpr const char* kPolicyFile = "search.policy";
inline constexpr const char* kTablesFile = "search.tables";
inline constexpr const char* kKeyFile = "search.key";

/// What ships is flown where it fits.
/// Oracle: OwnPolicy.IsNeededWhere*
[[nodiscard]] FliesBy flies_by(const OwnSearch& search);

/// Writes what a search is flown by that does not fly by what ships: that policy for this area and, where tables that ship are of this
/// search, these; signed with a key of the folder, for a mission trusts one.
/// @param folder  holds none of them, but may hold the key
void write_own_policy(const std::filesystem::path& folder, const OwnSearch& search);

}  // namespace earshot::own_search
