#pragma once

#include <filesystem>
#include <vector>

#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/transport/bus_lock.hpp"

namespace earshot::host {

/// The locks of all buses of a mission, held as long as the result is kept.
/// @param place  in a simulated flight
/// @throws BusInUse naming the bus and who uses it
[[nodiscard]] std::vector<BusLock> lock_buses(const MissionFile& mission, BusPlace place);
/// At sea, where nobody else is on them. @param folder  as lock_lcm_at_sea()
[[nodiscard]] std::vector<BusLock> lock_buses_at_sea(const MissionFile& mission, const std::filesystem::path& folder);

}  // namespace earshot::host
