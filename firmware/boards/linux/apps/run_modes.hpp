#pragma once

#include "firmware/boards/linux/apps/earshotd_options.hpp"

namespace earshot::board {

// The three things that earshotd can be asked for. Each returns the exit status.

/// Flies a vehicle at sea: on this host's clock, over the mission's ports, with a safety record. A vehicle that is under way, and with
/// whose mission this cannot go on, is brought up (fly_or_come_up.hpp).
[[nodiscard]] int fly_at_sea(const Options& o);

/// Flies in lock-step with a simulator, which drives the clock and gives the SNR. No vehicle is moved: there is no safety record.
/// @pre o.simulation names its domain
[[nodiscard]] int fly_in_simulation(const Options& o);

/// The checklist before a dive. Nothing is flown.
/// @throws host::BadInput when the mission could not be flown
[[nodiscard]] int check(const Options& o);

}  // namespace earshot::board
