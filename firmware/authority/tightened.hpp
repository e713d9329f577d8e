#pragma once

#include "firmware/config/mission.hpp"
#include "firmware/core/status.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::authority {

/// Puts an operator's limits in place of the mission's own. Its search keeps its share of the depth that it may go to, and its room above
/// the limit up to 5 m. Where the mission is: a second one would take 3 KiB of stack.
/// kOutOfRange: one of the limits is looser than the mission's, none is said, or the mission would contradict itself with them; it is as it
/// was.
[[nodiscard]] Status tighten(config::Mission& mission, const messages::OperatorLimits& limits);

}  // namespace earshot::authority
