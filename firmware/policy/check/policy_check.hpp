#pragma once

#include "firmware/policy/envelope/policy_fault.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::policy {

/// No element of an observation that `check` lets pass is greater than that, nor any logit, either side of zero.
inline constexpr double kMostElement = 1e9;
inline constexpr double kMostLogit = 1e30;

/// Finds what is wrong with a policy, wherever it came from: its sizes, its numbers, and whether an observation made inside its area could
/// have an element or a logit that is no number.
///
///   |element| <= (most |raw| + |offset|) |scale|        |logit| <= sum |w| + |b|, since |tanh| <= 1; a hidden layer likewise
///
/// Whether it repeats its golden trajectories is not looked at: that is repeats_golden's business.
/// Oracle: PolicyCheck.*
[[nodiscard, gnu::cold]] PolicyComplaint check(const FrozenPolicy& policy);

}  // namespace earshot::policy
