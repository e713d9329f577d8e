#pragma once

#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/host/mission/port_settings.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::host {

/// The tables [[port]] of a mission: at least one, no two on one bus.
/// @param navigation_timeout  of the mission, from which the defaults of a CAN port follow
[[nodiscard]] std::vector<PortSettings> read_ports(TableReader root, Duration navigation_timeout);

}  // namespace earshot::host
