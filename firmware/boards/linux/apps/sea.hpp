#pragma once

#include "firmware/boards/linux/apps/earshotd_options.hpp"

namespace earshot::board {

/// Flies a vehicle at sea: on this host's clock, over the mission's ports, with a safety record. A vehicle that is under way, and with
/// whose mission this cannot go on, is brought up (fly_or_come_up.hpp).
/// @return exit status
[[nodiscard]] int fly_at_sea(const Options& o);

}  // namespace earshot::board
