#pragma once

#include <optional>

#include "firmware/core/time.hpp"
#include "firmware/host/mission/port_settings.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::host {

/// What holds where a mission says nothing. Heading and depth may be as old as the wire's default allows, but never older than navigation
/// itself.
[[nodiscard]] N2kSettings default_n2k(Duration navigation_timeout);

/// Reads the table `n2k` of a CAN port: which device it is on its bus, and what it believes of the others. What is wrong is noted, also a
/// key that the port's roles have no use for.
/// @param table  none: everything by default
[[nodiscard]] N2kSettings read_n2k(std::optional<TableReader> table, Roles roles, Duration navigation_timeout);

}  // namespace earshot::host
