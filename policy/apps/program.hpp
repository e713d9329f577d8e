#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "firmware/host/file/output_file.hpp"
#include "firmware/host/program/command_line.hpp"
#include "firmware/policy/action_draw.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "sim/parallel/rank_session.hpp"

namespace earshot::apps {

/// Parses the command line and runs `body`. Bad input of any kind, a command line that is not UTF-8 among it (provenance and JSON could not
/// hold it), ends as one message on standard error and exit status 2.
int run_program(program::CommandLine& line, int argc, char** argv, const std::function<void()>& body);

/// The same of a program that mpirun may have started: rank 0 alone speaks, and the session outlives what it says, because mpirun drops the
/// words of a rank when another has ended.
int run_ranked_program(program::CommandLine& line, int argc, char** argv, const std::function<void(parallel::RankSession&)>& body);

/// A file that a program is to write, and the option that names it.
struct Output {
  std::string option;
  std::filesystem::path path;
  host::OutputKind kind;
};

inline constexpr host::OutputKind kPolicyOutput{"a .policy file", {"EARSHOTP", {}}};

/// What help says of --force.
inline constexpr const char* kForceHelp = "replace a file that is there already, of whatever kind it is";

/// Throws host::BadInput, naming both options, when two of them are one file: one would silently replace the other.
void check_distinct(std::span<const Output> files);

/// The same, and throws now rather than after minutes of work when one of them cannot be written later: see host::require_writable.
void require_writable(std::span<const Output> files, host::Replace replace);

/// With --verbose: what a policy sees and does, and its provenance line by line.
void tell_of_policy(const std::string& name, const policy::FrozenPolicy& policy);

/// @param name  "argmax" or "sampled", which the option's check has made sure of
[[nodiscard]] policy::ActionDraw draw_named(std::string_view name);

/// Throws host::BadInput when a picture of that name, given with `option`, cannot be drawn: it does not end in .png or .svg.
void check_picture_name(const std::string& option, const std::filesystem::path& path);

/// The folder policy/ that belongs to this program: the one of the tree it was built in, or that beside it in an installation.
/// Throws host::BadInput when there is none.
[[nodiscard]] std::filesystem::path data_folder();

/// The policy that ships. Throws host::BadInput when it is not there: no other stands in for it.
[[nodiscard]] std::filesystem::path shipped_policy();

}  // namespace earshot::apps
