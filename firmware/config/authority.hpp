#pragma once

#include "firmware/core/time.hpp"

namespace earshot::config {

/// What must be, before the vehicle is commanded.
struct Authority {
  bool needs_verified_commands = false;  ///< all but ABORT must bear the mark of who knows the vehicle's key
  Duration autopilot_timeout;            ///< no search begins with an autopilot that was silent for longer; 0: its status is not waited for
  friend constexpr bool operator==(const Authority&, const Authority&) = default;
};

}  // namespace earshot::config
