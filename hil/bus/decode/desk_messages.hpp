#pragma once

#include <span>

#include "firmware/wire/n2k/table/signal.hpp"

namespace earshot::hil {

/// Messages that recordings hold and the vehicle has no use for: they are read at a desk only, and stand in no list of what Earshot sends
/// or takes. Source: canboat's definitions 8.0.0-beta3 (Apache-2.0), after NMEA 2000.   Oracle: Value tests on canboat's samples
[[nodiscard]] std::span<const n2k::Message> desk_messages();

}  // namespace earshot::hil
