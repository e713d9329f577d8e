#pragma once

#include "earshot/mission_t.hpp"
#include "firmware/config/safety.hpp"

namespace earshot::wire {

// The safety supervisor's part of a mission_t.

void put_safety(const config::Safety& safety, mission_t& message);
/// Values are as they came, but for counts, which are cut to what there is room for: config::check judges them.
[[nodiscard]] config::Safety safety_in(const mission_t& message);

}  // namespace earshot::wire
