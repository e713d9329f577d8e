#pragma once

#include <vector>

#include "firmware/core/time.hpp"
#include "hil/bench/fault.hpp"
#include "hil/nodes/vehicle/disturbance.hpp"

namespace earshot::hil {

/// What those of a case's faults that act at a moment do to the vehicle and its instruments; errors of one kind add up.
/// @param tick  since the moment before that was asked for: a battery loses its charge once
[[nodiscard]] Disturbance disturbance_at(const std::vector<TimedFault>& faults, Time now, Duration tick);

}  // namespace earshot::hil
