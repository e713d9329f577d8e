#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/safety_record/safety_copies.hpp"

namespace earshot::board {

/// Where the copies of a flight's safety record stand, besides those that a person asks for.
struct SafetyFolders {
  std::optional<std::filesystem::path> state;    ///< of the service (STATE_DIRECTORY)
  std::optional<std::filesystem::path> runtime;  ///< likewise, in memory (RUNTIME_DIRECTORY)

  [[nodiscard]] static SafetyFolders of_this_process();
};

/// One beside the journal, one in each folder that is asked for or, where none is, in the service's state folder, and one in memory.
/// Outside of the journal's folder a copy bears that folder's name and a checksum of its path: flights do not share one.
/// @param out  the journal's folder
[[nodiscard]] std::vector<host::SafetyCopy> safety_places(const std::filesystem::path& out, const std::vector<std::string>& asked_for,
                                                          const SafetyFolders& folders);

}  // namespace earshot::board
