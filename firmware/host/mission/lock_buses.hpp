#pragma once

#include <optional>
#include <vector>

#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/transport/bus_lock.hpp"

namespace earshot::host {

/// The locks of all buses of a mission, held as long as the result is kept.
/// @param place  in a simulated flight; none: at sea, where nobody else is on them
/// @throws BusInUse naming the bus and who uses it
[[nodiscard]] std::vector<BusLock> lock_buses(const MissionFile& mission, std::optional<BusPlace> place);

}  // namespace earshot::host
