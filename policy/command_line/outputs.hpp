#pragma once

#include <filesystem>
#include <string>

#include "firmware/host/file/output_file.hpp"

namespace earshot::command_line {

inline constexpr host::OutputKind kPolicyOutput{"a .policy file", {"EARSHOTP", {}}};
inline constexpr host::OutputKind kTablesOutput{"a .tables file", {"EARSHOTT", {}}};

/// The description of --force in --help.
inline constexpr const char* kForceHelp = "replace a file that is there already, of whatever kind it is";

/// Throws host::BadInput when a picture of that name, given with `option`, cannot be drawn: it does not end in .png or .svg.
void check_picture_name(const std::string& option, const std::filesystem::path& path);

}  // namespace earshot::command_line
