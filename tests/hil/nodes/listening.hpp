#pragma once

#include <cstdint>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "hil/nodes/device.hpp"

namespace earshot::hil {

/// Steps a device every 10 ms of its time.
/// @return what it sends from `from`, which it comes to have stepped first, until before `until`
template <class AnyDevice>
[[nodiscard]] Frames run(AnyDevice& device, Time from, Time until) {
  Frames frames;
  for (Time now = from; now < until; now = now + Duration::milliseconds(10)) device.step(now, frames);
  return frames;
}

/// Those of a parameter group.
[[nodiscard]] inline Frames of_group(std::uint32_t pgn, const Frames& frames) {
  Frames found;
  for (const n2k::Frame& frame : frames) {
    if (n2k::parse_identifier(frame.identifier).value().pgn == pgn) found.push_back(frame);
  }
  return found;
}

}  // namespace earshot::hil
