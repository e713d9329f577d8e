#pragma once

#include "firmware/policy/frozen_policy.hpp"

namespace earshot::freeze {

/// Flies the searches that a vehicle will fly again before it trusts the policy, and writes them down as its golden trajectories: one from
/// the middle of the area where the policy decides, one that begins in a corner's border and goes round the compass. What is heard follows
/// the belief's own SNR against range, or a straight line where there is no belief, with some noise; the second search cannot measure it
/// every other time. The same policy gives the same searches.
/// @param policy  one that policy::check finds nothing wrong with
void fly_golden_searches(policy::FrozenPolicy& policy);

}  // namespace earshot::freeze
