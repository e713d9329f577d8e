#pragma once

#include "firmware/core/time.hpp"

namespace earshot::messages {

/// What a hydrophone says of itself.
struct HydrophoneStatus {
  Time time;
  bool is_deaf = false;  ///< its samples are still, clipped or below the noise of any sea
  friend constexpr bool operator==(const HydrophoneStatus&, const HydrophoneStatus&) = default;
};

}  // namespace earshot::messages
