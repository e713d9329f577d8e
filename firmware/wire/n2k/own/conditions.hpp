#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/wire/n2k/frame.hpp"

namespace earshot::n2k {

// How hull, autopilot and hydrophone are, as they say it themselves, for which no standard group is there. One frame each, without a date:
// its arrival stands for it. Reading fails as decode() does, with kUnsupported for another maker's message, and with kOutOfRange for a yes
// or no that is neither.

/// Of one hull or compartment. What a device does not watch it leaves out.
struct Hull {
  std::optional<std::uint8_t> instance;
  std::optional<bool> wet;  ///< water inside
  std::optional<bool> has_ground_fault;
};
[[nodiscard]] Status compose_hull(const Hull& hull, std::uint8_t source, Frame& frame);
/// kNotReady: it says neither.
[[nodiscard]] Result<Hull> read_hull(std::span<const std::uint8_t> bytes);

/// What an autopilot says of itself.
struct AutopilotCondition {
  bool follows_setpoints = false;
  std::optional<std::uint8_t> heading_sequence;  ///< of the last set-point that it took (65290)
};
[[nodiscard]] Status compose_autopilot_status(const AutopilotCondition& condition, std::uint8_t source, Frame& frame);
[[nodiscard]] Result<AutopilotCondition> read_autopilot_status(std::span<const std::uint8_t> bytes);

/// In the group of the SNR, which is left out.
[[nodiscard]] Status compose_deaf(bool is_deaf, std::uint8_t source, Frame& frame);
/// kNotReady: the hydrophone does not say whether it is.
[[nodiscard]] Result<bool> read_deaf(std::span<const std::uint8_t> bytes);

}  // namespace earshot::n2k
