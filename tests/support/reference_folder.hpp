#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace earshot::support {

/// Recordings and other data that are no part of the project: EARSHOT_REFERENCE_DIR, or shared/reference beside the project.
inline std::filesystem::path reference_folder() {
  const char* const named = std::getenv("EARSHOT_REFERENCE_DIR");  // NOLINT(concurrency-mt-unsafe): one thread
  return named != nullptr ? std::filesystem::path(named) : std::filesystem::path(EARSHOT_SOURCE_DIR) / "../shared/reference";
}

/// Whether a test must fail, not be skipped, where they are not there: EARSHOT_REFERENCE_REQUIRED=1.
inline bool is_reference_required() {
  const char* const required = std::getenv("EARSHOT_REFERENCE_REQUIRED");  // NOLINT(concurrency-mt-unsafe): one thread
  return required != nullptr && std::string(required) == "1";
}

}  // namespace earshot::support
