#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/core/fixed_vector.hpp"
#include "firmware/host/mission/port_settings.hpp"
#include "firmware/host/transport/can/filter.hpp"

namespace earshot::board {

/// More than the roles of a port together send or read; full: does not happen, a test looks.
inline constexpr std::size_t kMostPgns = 24;
using Pgns = FixedVector<std::uint32_t, kMostPgns>;

/// The groups that a CAN port sends for its roles and as a device of its bus: what it tells everybody who asks (126464).
[[nodiscard]] Pgns pgns_sent(host::Roles roles);
/// Likewise those that it reads.
[[nodiscard]] Pgns pgns_read(host::Roles roles);
/// What the kernel is to let through: the groups that are read, from whomever.
[[nodiscard]] host::CanFilters filters_of(host::Roles roles);

}  // namespace earshot::board
