#pragma once

#include <functional>
#include <optional>

#include "firmware/boards/linux/apps/earshotd_options.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"

namespace earshot::board {

/// Flies at sea. The safety record is read before anything else; with --resume a vehicle that it says is under way, and with which `fly`
/// cannot go on, whatever the reason, is brought up: status 2 means that nothing was under way.
/// @return exit status
[[nodiscard]] int fly_or_come_up(const Options& o, const HostClock& host, const std::function<int(host::SafetyCopies&)>& fly);

/// Likewise when its command line could not be read: brings up the vehicle of the folder that it names.
/// @return exit status; nothing: none is under way there, or nobody asked to go on
[[nodiscard]] std::optional<int> come_up_by(int argc, const char* const* argv);

}  // namespace earshot::board
