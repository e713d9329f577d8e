#pragma once

#include <filesystem>
#include <string>

namespace earshot::host {

/// A process of this machine, for a person: "earshot-fly (process 4711)".
[[nodiscard]] std::string name_of_process(const std::string& number);

/// Whether a process that is still listed has been killed: each of its threads has SIGKILL pending, or no memory any more (proc(5):
/// status). It runs none of its own code again, but keeps its files and their locks while a disk that hangs holds it.
/// @param process  its folder, such as /proc/4711; false where it is not there
/// Oracle: Process.*
[[nodiscard]] bool is_killed(const std::filesystem::path& process);

}  // namespace earshot::host
