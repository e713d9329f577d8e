#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "firmware/host/file/output_file.hpp"

namespace earshot::command_line {

/// A file that a program is to write, and the option that names it.
struct Output {
  std::string option;
  std::filesystem::path path;
  host::OutputKind kind;
};

inline constexpr host::OutputKind kPolicyOutput{"a .policy file", {"EARSHOTP", {}}};
inline constexpr host::OutputKind kTablesOutput{"a .tables file", {"EARSHOTT", {}}};

/// The description of --force in --help.
inline constexpr const char* kForceHelp = "replace a file that is there already, of whatever kind it is";

/// Throws host::BadInput, naming both options, when two of them are one file: one would silently replace the other.
void check_distinct(std::span<const Output> files);

/// Throws host::BadInput, naming both options, when one of the outputs is the file that is read: it would be replaced.
/// @param option  that names the file
void check_is_none_of(std::span<const Output> outputs, const std::string& option, const std::filesystem::path& read);

/// check_distinct(), and throws now rather than after minutes of work when one of them cannot be written later: see host::require_writable.
void require_writable(std::span<const Output> files, host::Replace replace);

/// Throws host::BadInput when a picture of that name, given with `option`, cannot be drawn: it does not end in .png or .svg.
void check_picture_name(const std::string& option, const std::filesystem::path& path);

}  // namespace earshot::command_line
