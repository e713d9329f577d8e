#pragma once

#include <vector>

#include "firmware/core/time.hpp"
#include "hil/bench/fault.hpp"
#include "hil/nodes/disturbance.hpp"

namespace earshot::hil {

/// What the faults that act at `now` make of the vehicle and its instruments. What happens once (the battery's charge) does so in the tick
/// in which its fault begins.
[[nodiscard]] Disturbance disturbance_of(const std::vector<TimedFault>& faults, Time now, Duration tick);

}  // namespace earshot::hil
