#pragma once

#include <string>

namespace earshot::program {

/// Of the project, such as 0.2.0.
[[nodiscard]] std::string version();

/// Commit the programs were built from, "-dirty" appended when the tree differed, or held a file unknown to git; "unknown" outside a
/// repository.
[[nodiscard]] std::string build_commit();

}  // namespace earshot::program
