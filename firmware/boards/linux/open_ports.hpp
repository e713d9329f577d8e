#pragma once

#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/boards/linux/hydrophone/hydrophone_processor.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/transport/if_missing.hpp"

namespace earshot::board {

/// The ports that the mission describes, in its order.
/// @param host        must outlive the ports
/// @param wakes       how often a hydrophone's port wakes the loop
/// @param if_missing  whether a link whose interface is not there is an error, or down until it comes
/// @throws std::system_error naming what cannot be opened.
void open_ports(const host::MissionFile& mission, const HostClock& host, host::IfMissing if_missing, WakesFor wakes, PortSet& ports);

}  // namespace earshot::board
