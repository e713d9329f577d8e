#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/transport/bus_lock.hpp"
#include "hil/bench/case.hpp"

namespace earshot::hil {

// What can be wrong with cases, with the folder of their results and with their bus, before the first of them is flown.

/// Each has a mission that can be read, and a name that can be a folder's and no other case's; there is one at least.
/// @throws host::BadInput
void require_flyable(const std::vector<Case>& cases);

/// The file of a run's results.
[[nodiscard]] std::filesystem::path results_file(const std::filesystem::path& out);

/// Makes the folder of a run. @return its lock: two runs in one folder would judge each other's journals
/// @throws host::BadInput also when its results cannot be written, or are somebody else's file
[[nodiscard]] host::FileDescriptor take_folder(const std::filesystem::path& out);

/// @return the CAN interface's lock, where one of the cases needs it: two runs on one bus would be a vehicle with two of each device
/// @throws host::BusInUse; host::BadInput of one that is down; std::system_error of one that is not there or no CAN bus
[[nodiscard]] std::optional<host::BusLock> take_bus(const std::vector<Case>& cases, const std::string& interface);

}  // namespace earshot::hil
