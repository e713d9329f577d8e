#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "firmware/core/units.hpp"
#include "firmware/messages/bearing_measurement.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "policy/explain/recorded_decision.hpp"

namespace earshot::explain {

/// A policy with random weights that sees its belief, for an ocean of 40 dB at the source and 1 dB less every kilometre.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> belief_policy(std::uint64_t seed);
/// The same network arithmetic on the paper's simple state.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> place_policy(std::uint64_t seed);

inline constexpr Decibels kFloor{31.0};

/// What a vehicle writes down that flies the policy past a source, decision by decision with the arithmetic that flies.
/// The first look is too faint to measure, under kFloor. Its area begins at `south_west`; the source stands 12 km north and 15 km east of
/// that, the start 8 km and 6 km. @param bearing  that every look bears
[[nodiscard]] std::vector<RecordedDecision> flown(const policy::FrozenPolicy& policy, std::size_t decisions, NorthEast south_west,
                                                  const std::optional<messages::Bearing>& bearing = std::nullopt);

}  // namespace earshot::explain
