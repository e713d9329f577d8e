#pragma once

#include <string>

#include "firmware/boards/linux/apps/earshotd_options.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"

namespace earshot::board {

/// Brings up a vehicle that was under way and whose mission cannot go on: says why, opens what ports it can, and tells stop and come up on
/// all of them (ComingUp) until somebody stops the program.
/// @pre the copies hold a record
/// @return exit status
[[nodiscard]] int come_up(const Options& o, host::SafetyCopies& copies, const HostClock& host, const std::string& why);

}  // namespace earshot::board
