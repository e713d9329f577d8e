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
///   |element| <= (most |raw| + |offset|) |scale|        |sum| <= sum |w| most + |b|, of a layer whose inputs are at most `most`
///
/// After a tanh `most` is one, after a ReLU the largest of the layer's bounds.
///
/// Whether it repeats its golden trajectories is not looked at: that is repeats_golden's business.
/// Oracle: PolicyCheck.*
[[nodiscard, gnu::cold]] PolicyComplaint check(const FrozenPolicy& policy);

/// Whether a network, which there is, has layers of an activation that is known, whose sizes are possible and fit: kUnknownActivation,
/// kBadShape, kTooLarge. Its weights are not looked at.
[[nodiscard, gnu::cold]] PolicyFault fault_in_shape(const Network& network);

/// The complaint with the size of the network that it is about, if it is its size.
[[nodiscard, gnu::cold]] PolicyComplaint with_size(PolicyComplaint complaint, const Network& network);

}  // namespace earshot::policy
