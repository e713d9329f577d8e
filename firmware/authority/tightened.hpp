#pragma once

#include "firmware/config/mission.hpp"
#include "firmware/core/status.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::authority {

/// The mission with an operator's limits in place of its own. Its search keeps its share of the depth that it may go
/// to, and its room above the limit up to 5 m.
/// kOutOfRange: one of the limits is looser than the mission's, none is said, or the mission would contradict itself with them.
[[nodiscard]] Result<config::Mission> tightened(const config::Mission& mission, const messages::OperatorLimits& limits);

}  // namespace earshot::authority
