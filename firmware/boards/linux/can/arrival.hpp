#pragma once

#include "firmware/core/time.hpp"

namespace earshot::board {

/// When a frame arrived.
struct Arrival {
  Time utc;      ///< by this host's wall clock
  Time mission;  ///< by the mission's
};

}  // namespace earshot::board
