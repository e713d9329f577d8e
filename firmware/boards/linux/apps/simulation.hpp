#pragma once

#include "firmware/boards/linux/apps/earshotd_options.hpp"

namespace earshot::board {

/// Flies in lock-step with a simulator, which drives the clock and gives the SNR. No vehicle is moved: there is no safety record.
/// @pre o.simulation names its domain
/// @return exit status
[[nodiscard]] int fly_in_simulation(const Options& o);

}  // namespace earshot::board
