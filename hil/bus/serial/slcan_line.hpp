#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "firmware/wire/n2k/frame.hpp"
#include "firmware/wire/n2k/node/node.hpp"

namespace earshot::hil {

// What a CAN adapter at the end of a serial line and its computer say to each other, a line each, as Linux's slcan has it.
// Source: Linux 6.1, drivers/net/can/slcan/slcan-core.c.   Oracle: SlcanLine tests, SerialAdapter tests (the kernel as the other side)

/// "T1CEAFF2330100EE\r": a frame, either way.
[[nodiscard]] std::string to_line(const n2k::Frame& frame);

/// "sp128000\r": how the adapter's controller is, with as many errors of reception and of sending as it takes for that.
[[nodiscard]] std::string to_line(n2k::ControllerState state);

/// The frame of a line without its end; nothing if it is another one, or none of ours.
[[nodiscard]] std::optional<n2k::Frame> read_line(std::string_view line);

}  // namespace earshot::hil
