#pragma once

#include "firmware/core/time.hpp"

namespace earshot::messages {

/// What the autopilot says of itself.
struct AutopilotStatus {
  Time time;
  bool follows_setpoints = false;  ///< false: a person or another mission steers
  friend constexpr bool operator==(const AutopilotStatus&, const AutopilotStatus&) = default;
};

}  // namespace earshot::messages
