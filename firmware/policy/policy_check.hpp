#pragma once

#include "firmware/policy/frozen_policy.hpp"
#include "firmware/policy/policy_fault.hpp"

namespace earshot::policy {

/// No element of an observation that `check` lets pass is greater than that, nor any logit, either side of zero.
inline constexpr double kMostElement = 1e9;
inline constexpr double kMostLogit = 1e30;

/// What would be wrong with the policy itself, however it came about: sizes, numbers, and whether any observation made inside its area
/// could make an element or a logit that is no number.
///
///   |element| <= (most |raw| + |offset|) |scale|        |logit| <= sum |w| + |b|, since |tanh| <= 1; a hidden layer likewise
///
/// Whether it repeats its golden trajectories is not looked at: that is repeats_golden's business.
/// Oracle: PolicyCheck.*
[[nodiscard]] PolicyComplaint check(const FrozenPolicy& policy);

}  // namespace earshot::policy
