#pragma once

namespace earshot::runtime {

/// Whether this build, in searches that are written in its code, does between logits and set-point what the core's own build does, bit for
/// bit: softmax and draw, mean over a window, limits, leg, heading. A policy's golden trajectories end with the logits; these steps are the
/// rest of the way, the same whatever the policy. A build that fuses multiply-adds does not repeat them.
/// Oracle: ContractedBuild.*, ContractedLeg.*, CoresArithmetic.*
[[nodiscard, gnu::cold]] bool repeats_known_steps();

}  // namespace earshot::runtime
