#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/safety_record/in_memory.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"

namespace earshot::board {

/// Where the copies of a flight's safety record stand, besides those that a person asks for.
struct SafetyFolders {
  std::optional<std::filesystem::path> state;    ///< of the service (STATE_DIRECTORY)
  std::optional<std::filesystem::path> runtime;  ///< likewise, in memory (RUNTIME_DIRECTORY)

  [[nodiscard]] static SafetyFolders of_this_process();
};

/// What this computer is told by: its machine-id, where that outlives a start, and the serial number of its board.
struct ComputerFiles {
  std::filesystem::path machine_id = "/etc/machine-id";
  std::filesystem::path transient_machine_id = "/run/machine-id";  ///< there is one: the machine-id was drawn for this start alone
  std::filesystem::path serial_number = "/sys/firmware/devicetree/base/serial-number";
};

/// Whose records in the folder count: this computer's, of flights in this folder. A record that was copied here with its journal, from
/// another vehicle or another folder, puts nothing under way. @param out  the journal's folder
[[nodiscard]] host::RecordOwner record_owner(const std::filesystem::path& out, const ComputerFiles& files = {});

/// Tells whether a folder is in memory alone.
using DetectsMemory = bool (*)(const std::filesystem::path& folder);

/// One beside the journal, one in each folder that is asked for or, where none is, in the service's state folder, and one in memory. Where
/// there is none on another disk a second one stands beside the journal: a file that is removed, or damaged, is then not the only one.
/// Outside of the journal's folder a copy bears that folder's name and a checksum of its path: flights do not share one.
/// One in a folder that is in memory alone survives no power cut either, whoever asked for it.
/// @param out  the journal's folder
[[nodiscard]] std::vector<host::SafetyCopy> safety_places(const std::filesystem::path& out, const std::vector<std::string>& asked_for,
                                                          const SafetyFolders& folders, DetectsMemory is_in_memory = &host::is_in_memory);

/// What a person should know of them: those of a disk that is in memory alone, and that none survives a power cut.
[[nodiscard]] std::vector<std::string> warnings_about(const std::vector<host::SafetyCopy>& places, const SafetyFolders& folders);

}  // namespace earshot::board
