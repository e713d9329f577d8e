#pragma once

#include <memory>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "firmware/runtime/runtime.hpp"
#include "tests/fuzz/mutation.hpp"

namespace earshot::fuzz {

/// The random walk, and three that see a belief of 12 x 10 cells: small, so that many can be flown. The last goes by its belief's own
/// advice.
[[nodiscard]] std::vector<Bytes> good_policies();

/// The same policy as a careless freezer would have frozen it: its golden trajectories are those of its own numbers.
[[nodiscard]] Bytes frozen_anew(const Bytes& bytes);

/// Throws std::logic_error when the policy does what none may.
/// @param random  what is heard
/// @return whether the runtime took the policy and flew it, in three oceans
bool flies(const policy::FrozenPolicy& policy, runtime::Runtime& runtime, Pcg32& random);

}  // namespace earshot::fuzz
